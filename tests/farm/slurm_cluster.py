"""A Slurm of one machine, this one, of Debian's packages: its own munge, its own ports, all it writes in one folder."""

import getpass
import os
import pathlib
import signal
import socket
import subprocess
import time

CONF = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=100000
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
KillWait=2
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=8000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_until(what, holds, seconds):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise TimeoutError(f"{what}: not within {seconds} s")
        time.sleep(0.1)


class Cluster:
    """with Cluster(folder, cpus) as cluster: runs the daemons until the end; cluster.environment is that of programs that use it."""

    def __init__(self, folder, cpus):
        self.folder = pathlib.Path(folder)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.daemons = {}
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        port, node_port = free_ports(2)
        host = socket.gethostname().split(".")[0]
        self.conf = CONF.format(host=host, port=port, node_port=node_port, folder=self.folder, user=getpass.getuser(), cpus=cpus)
        self.folder.chmod(0o755)  # munge wants that no other may write there

    def __enter__(self):
        (self.folder / "slurm.conf").write_text(self.conf)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        at = lambda name: f"{self.folder}/munge.{name}"
        try:
            self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={at('socket')}", f"--pid-file={at('pid')}",
                       f"--seed-file={at('seed')}", f"--log-file={at('log')}")
            wait_until("munge's socket", (self.folder / "munge.socket").exists, 60)
            self.start("slurmctld", "-D", "-c")
            self.start_node()
            wait_until("an idle node", lambda: "idle" in self.ask("sinfo", "-h", "-o", "%t"), 120)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for name in reversed(list(self.daemons)):
            self.stop(name)

    def start(self, name, *arguments):
        with open(self.folder / f"{name}.out", "ab") as out:
            self.daemons[name] = subprocess.Popen([f"/usr/sbin/{name}", *arguments], env=self.environment, stdin=subprocess.DEVNULL,
                                                  stdout=out, stderr=out)

    def start_node(self):
        self.start("slurmd", "-D")

    def stop(self, name):
        daemon = self.daemons.pop(name)
        daemon.send_signal(signal.SIGTERM)
        try:
            daemon.wait(10)
        except subprocess.TimeoutExpired:
            daemon.kill()
            daemon.wait()

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, stdin=subprocess.DEVNULL).stdout
