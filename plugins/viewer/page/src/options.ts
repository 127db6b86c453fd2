// SPDX-License-Identifier: Apache-2.0

// What the page's address asks for.
export interface Options {
  token: string;
  theme: string | null;
  colour: string | null;
  walls: boolean | null;
  particles: boolean | null;
  context: boolean | null;
  camera: number[] | null;
  picture: { width: number; height: number } | null; // instead of the page with its panels
}

export function readOptions(search: string): Options {
  const query = new URLSearchParams(search);
  const flag = (name: string): boolean | null =>
    query.has(name) ? query.get(name) !== '0' && query.get(name) !== 'false' : null;
  const size = (name: string, usual: number): number => {
    const value = Number(query.get(name) ?? usual);
    return Number.isFinite(value) ? Math.min(8192, Math.max(16, Math.round(value))) : usual;
  };
  const camera = (query.get('camera') ?? '').split(',').map(Number);
  const isCamera = (camera.length === 6 || camera.length === 7) && camera.every(Number.isFinite);
  return {
    token: query.get('token') ?? '',
    theme: query.get('theme'),
    colour: query.get('colour'),
    walls: flag('walls'),
    particles: flag('particles'),
    context: flag('context'),
    camera: isCamera ? camera : null,
    picture: flag('picture') ? { width: size('width', 1280), height: size('height', 800) } : null,
  };
}
