// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { fill, h } from '../dom';
import { Emitter } from '../events';
import type { ComponentInfo, NodeInfo } from '../protocol';

export type Chosen = NodeInfo | ComponentInfo;

export function isComponent(chosen: Chosen): chosen is ComponentInfo {
  return 'type' in chosen;
}

// What is chosen in the tree; it stays chosen by its path when the scene is read again.
export class Selection extends Emitter<{ changed: Chosen | null }> {
  path: string | null = null;
  chosen: Chosen | null = null;

  choose(chosen: Chosen | null): void {
    this.chosen = chosen;
    this.path = chosen?.path ?? null;
    this.emit('changed', chosen);
  }
}

// The scene's nodes and components.
export function tree(app: App, selection: Selection): HTMLElement {
  const list = h('div', { className: 'tree', aria: { role: 'tree', label: 'Scene' } });
  const folded = new Set<string>();
  const refresh = (): void => {
    const root = app.model.scene?.root;
    if (root) fill(list, nodeEntry(root, 0, selection, folded, refresh));
  };
  app.model.on('scene', (scene) => {
    selection.choose(selection.path ? find(scene.root, selection.path) : null);
    refresh();
  });
  selection.on('changed', refresh);
  return list;
}

function nodeEntry(
  node: NodeInfo,
  depth: number,
  selection: Selection,
  folded: Set<string>,
  refresh: () => void,
): HTMLElement {
  const open = !folded.has(node.path);
  const row = h(
    'div',
    { className: 'row node', style: { paddingLeft: `${4 + 12 * depth}px` } },
    h(
      'button',
      {
        className: 'fold',
        title: open ? 'Fold' : 'Unfold',
        aria: { expanded: String(open) },
        onclick: () => {
          if (open) folded.add(node.path);
          else folded.delete(node.path);
          refresh();
        },
      },
      open ? '▾' : '▸',
    ),
    entryButton(node, node.name, '', selection),
  );
  const box = h('div', {}, row);
  if (!open) return box;
  for (const component of node.components) {
    const plain = component.name.toLowerCase() === component.type.toLowerCase();
    box.append(
      h(
        'div',
        { className: 'row', style: { paddingLeft: `${24 + 12 * depth}px` } },
        entryButton(component, component.name, plain ? '' : component.type, selection),
      ),
    );
  }
  for (const child of node.children) {
    box.append(nodeEntry(child, depth + 1, selection, folded, refresh));
  }
  return box;
}

function entryButton(what: Chosen, name: string, type: string, selection: Selection): HTMLElement {
  const changed = what.attributes.some((attribute) => attribute.isSet && attribute.runtime);
  return h(
    'button',
    {
      className: 'entry',
      data: { path: what.path },
      title: what.path,
      onclick: () => selection.choose(what),
      aria: { role: 'treeitem', selected: String(selection.path === what.path) },
    },
    h('span', { className: changed ? 'tunable' : '' }, name),
    type && h('small', {}, type),
  );
}

function find(node: NodeInfo, path: string): Chosen | null {
  if (node.path === path) return node;
  const component = node.components.find((one) => one.path === path);
  if (component) return component;
  for (const child of node.children) {
    const found = find(child, path);
    if (found) return found;
  }
  return null;
}
