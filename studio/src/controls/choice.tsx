import type { JSX } from "preact";

// Some words of which one is chosen, by the pointer; Tab stops at that one, and arrow keys go on to the others.

interface Props {
  label: string;
  words: readonly string[];
  titles?: readonly string[];
  chosen: number;
  choose: (index: number) => void;
  tabs?: boolean; // views, of which one is shown; told of each click, for what was chosen a moment ago may not be drawn yet
  look?: string; // its class
}

export function Choice({ label, words, titles, chosen, choose, tabs = false, look = "kinds" }: Props): JSX.Element {
  const step = (event: KeyboardEvent & { currentTarget: HTMLElement }): void => {
    const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const next = (chosen + by + words.length) % words.length;
    (event.currentTarget.children[next] as HTMLElement).focus();
    choose(next);
  };
  return (
    <div class={look} role={tabs ? "tablist" : "radiogroup"} aria-label={label} onKeyDown={step}>
      {words.map((word, i) => {
        const on = i === chosen;
        return (
          <button key={word} {...(tabs ? { role: "tab", "aria-selected": on } : { role: "radio", "aria-checked": on })} class={on ? "on" : ""} tabIndex={on ? 0 : -1}
            title={titles?.[i]} onClick={() => (on && !tabs) || choose(i)}>{word}</button>
        );
      })}
    </div>
  );
}
