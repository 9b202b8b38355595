// What a browser keeps of a page: for this tab, and for tabs that are opened later. Denied or full, it keeps nothing.

const places = [() => sessionStorage, () => localStorage];

export function kept(key: string): string | undefined {
  for (const place of places) {
    try {
      const value = place().getItem(key);
      if (value !== null) return value;
    } catch {
      // The next may be allowed.
    }
  }
  return undefined;
}

export function keep(key: string, value: string): void {
  for (const place of places) {
    try {
      place().setItem(key, value);
    } catch {
      // The other may have room.
    }
  }
}
