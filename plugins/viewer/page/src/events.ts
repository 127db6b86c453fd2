// SPDX-License-Identifier: Apache-2.0

// Listeners by name of the event; `Events` maps names to what is handed over.
export class Emitter<Events extends object> {
  private readonly listeners = new Map<keyof Events, ((value: never) => void)[]>();

  on<K extends keyof Events>(name: K, listener: (value: Events[K]) => void): void {
    const list = this.listeners.get(name) ?? [];
    list.push(listener as (value: never) => void);
    this.listeners.set(name, list);
  }

  emit<K extends keyof Events>(name: K, value: Events[K]): void {
    for (const listener of this.listeners.get(name) ?? []) {
      (listener as (value: Events[K]) => void)(value);
    }
  }
}
