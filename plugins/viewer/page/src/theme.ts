// SPDX-License-Identifier: Apache-2.0
import { Emitter } from './events';

export type Theme = 'light' | 'dark';

// Light or dark: what the address asks for, what was chosen before, else what the system prefers.
export class Themes extends Emitter<{ changed: Theme }> {
  current: Theme;

  constructor(asked: string | null) {
    super();
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    const chosen = asked ?? localStorage.getItem('stroma.theme');
    this.current =
      chosen === 'light' || chosen === 'dark' ? chosen : dark.matches ? 'dark' : 'light';
    dark.addEventListener('change', () => {
      if (!localStorage.getItem('stroma.theme')) this.apply(dark.matches ? 'dark' : 'light');
    });
    this.apply(this.current);
  }

  toggle(): void {
    this.apply(this.current === 'dark' ? 'light' : 'dark');
    localStorage.setItem('stroma.theme', this.current);
  }

  colour(name: string): string {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  }

  private apply(theme: Theme): void {
    this.current = theme;
    document.documentElement.dataset.theme = theme;
    this.emit('changed', theme);
  }
}
