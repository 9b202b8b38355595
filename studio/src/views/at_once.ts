import { effect, untracked } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

// As useSignalEffect(), which waits for the next frame to be drawn before it calls: what asks for a picture must not.
export function useEffectAtOnce(callback: () => void): void {
  const latest = useRef(callback);
  latest.current = callback;
  useEffect(() => effect(() => latest.current()), []);
}

// Whether one of the parts is another than when this was asked last.
export function areOthers(parts: unknown[], last: { current: unknown[] }): boolean {
  if (parts.every((part, i) => part === last.current[i])) return false;
  last.current = parts;
  return true;
}

// Acts where one of the `parts` has become another, whatever else has.
export function useChanges(parts: () => unknown[], act: () => void): void {
  const last = useRef<unknown[]>([]);
  useEffectAtOnce(() => {
    if (areOthers(parts(), last)) untracked(act);
  });
}
