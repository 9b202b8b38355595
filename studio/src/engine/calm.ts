import { options } from "preact";

// The picture that a slider is moved for comes before the controls that show where the slider is: these are made anew when the picture is
// on the screen, or after as long as an eye does not notice.

const kUnnoticed = 60; // milliseconds

let pictures = 0; // that are on their way
let waiting: (() => void) | undefined;
let timer: ReturnType<typeof setTimeout> | undefined;

function flush(): void {
  clearTimeout(timer);
  const work = waiting;
  waiting = undefined;
  work?.();
}

// A picture that follows something is begun, and is there.
export const busy = (): void => void ++pictures;
export function idle(): void {
  --pictures;
  // After the frame that shows it.
  requestAnimationFrame(() => setTimeout(flush));
}

// Preact has one piece of work at a time.
options.debounceRendering = (work) => queueMicrotask(() => {
  if (pictures === 0) return work();
  waiting = work;
  clearTimeout(timer);
  timer = setTimeout(flush, kUnnoticed);
});
