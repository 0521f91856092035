// What is chosen in the page, shared by its parts.

/** A record of values; `set` tells those who listen which have changed. */
export function createState(initial) {
  const values = {...initial};
  const listeners = [];
  return {
    get: (name) => values[name],
    set(changes) {
      const changed = Object.keys(changes).filter((name) => values[name] !== changes[name]);
      if (changed.length === 0) return;
      Object.assign(values, changes);
      for (const {names, call} of listeners) {
        if (names.some((name) => changed.includes(name))) call();
      }
    },
    /** Calls `call` after any of `names` has changed. */
    listen(names, call) {
      listeners.push({names, call});
    },
  };
}

export const REFERENCE = 'reference';
