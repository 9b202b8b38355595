import type { JSX } from "preact";
import { useState } from "preact/hooks";

// What leaves the page: texts, to the clipboard or as files.

export function CopyButton({ text, label }: { text: () => string; label: string }): JSX.Element {
  const [said, say] = useState("");
  return (
    <button class="wide" onClick={async () => {
      say(await navigator.clipboard.writeText(text()).then(() => "Copied", () => "Not allowed"));
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
