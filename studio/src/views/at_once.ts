import { effect, untracked } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

// As useSignalEffect(), which waits for the next frame to be drawn before it calls: what asks for a picture must not.
export function useEffectAtOnce(callback: () => void): void {
  const latest = useRef(callback);
  latest.current = callback;
  useEffect(() => effect(() => latest.current()), []);
}

// Acts where one of the `parts` has become another, whatever else has.
export function useChanges(parts: () => unknown[], act: () => void): void {
  const last = useRef<unknown[]>([]);
  useEffectAtOnce(() => {
    const now = parts();
    if (now.every((part, i) => part === last.current[i])) return;
    last.current = now;
    untracked(act);
  });
}
