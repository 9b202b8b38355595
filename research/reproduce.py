"""reproduce.py DATA DOCS [ITEM...]: computes the items that are named, or not in the folder DATA yet, and writes the papers' pages and figures to DOCS."""

import importlib
import pathlib
import pickle
import sys
import time

import solidnoise

from pages.drawing import Page

PAGES = ("improving_gabor_noise", "noise_by_example", "gradient_noise", "implementation_report", "impulses_in_strata")


def main(data, docs, *wanted):
    folder = pathlib.Path(data)
    folder.mkdir(parents=True, exist_ok=True)
    items = {page: importlib.import_module(f"papers.{page}").ITEMS for page in PAGES}
    known = [name for of_page in items.values() for name in of_page]
    for name in wanted:
        if name not in known:
            sys.exit(f"reproduce: no item {name}; there are {', '.join(known)}")
    for page, of_page in items.items():
        found = {}
        for name, compute in of_page.items():
            path = folder / f"{name}.pickle"
            if name in wanted or not path.exists():
                begin = time.monotonic()
                path.write_bytes(pickle.dumps(compute()))
                print(f"reproduce: {name}, {time.monotonic() - begin:.0f} s", flush=True)
            found |= pickle.loads(path.read_bytes())
        written = Page(page.replace("_", "-"), docs)
        importlib.import_module(f"pages.{page}").write(found, written)
        written.save(f"Solidnoise, values of version {solidnoise.algorithm}")


main(*sys.argv[1:])
