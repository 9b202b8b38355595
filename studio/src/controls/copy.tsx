import type { JSX } from "preact";
import { useState } from "preact/hooks";

// What leaves the page: texts, to the clipboard or as files, and commands for a shell.

// Pages that are not from this machine or by https have no clipboard of their own.
async function copy(text: string): Promise<string> {
  try {
    await navigator.clipboard.writeText(text);
    return "Copied";
  } catch {
    const area = document.createElement("textarea");
    area.value = text;
    (document.querySelector("dialog[open]") ?? document.body).append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done ? "Copied" : "Not allowed";
  }
}

export function CopyButton({ text, label }: { text: () => string; label: string }): JSX.Element {
  const [said, say] = useState("");
  return (
    <button class="wide" onClick={async () => {
      say(await copy(text()));
      setTimeout(() => say(""), 1200);
    }}>{said || label}</button>
  );
}

export function saveAs(name: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// A word of a command as a shell takes it; no file's name is taken for a flag.
export const quoted = (word: string): string => (/^[\w./+:=,@%-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
export const fileWord = (name: string): string => quoted(name.startsWith("-") ? `./${name}` : name);

export function Commands({ commands, hint }: { commands: string[]; hint: string }): JSX.Element {
  return (
    <section class="commands">
      <h2>In the shell</h2>
      {commands.map((command) => (
        <div class="command" key={command}>
          <code>{command.replace(/(#.{14})[^']*/, "$1…")}</code>
          <CopyButton label="Copy" text={() => command} />
        </div>
      ))}
      <p class="hint">{hint}</p>
    </section>
  );
}
