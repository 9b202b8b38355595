import { render } from "preact";
import { App } from "./app.tsx";
import { engine, startEngine } from "./engine/engine.ts";
import { kept } from "./engine/kept.ts";
import { begin, redo, undo } from "./store.ts";
import { starts } from "./starts.ts";
import "./drop.ts";
import "./studio.css";

const root = document.getElementById("studio")!;
document.documentElement.dataset.theme = kept("solidnoise-theme") ?? (matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");

const textOf = (name: string): string => starts.find((start) => start.name === name)!.text;

try {
  await startEngine();
  await begin(engine.desk, textOf("raw"), textOf("rust"));
  engine.times.start = performance.now();
  root.replaceChildren();
  render(<App />, root);
} catch (error) {
  root.innerHTML = "";
  const text = document.createElement("p");
  text.className = "starting";
  text.textContent = `Solidnoise Studio cannot start: ${(error as Error).message}`;
  root.append(text);
}

addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey)) return;
  const typing = event.target instanceof HTMLTextAreaElement;
  if (typing) return;
  if (event.key.toLowerCase() === "z") {
    event.preventDefault();
    if (event.shiftKey) redo();
    else undo();
  } else if (event.key.toLowerCase() === "y") {
    event.preventDefault();
    redo();
  }
});

// For those who measure.
Object.assign(globalThis, { studioTimes: engine.times });
