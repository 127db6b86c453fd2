// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { fill, h, section, setText } from '../dom';
import { formatQuantity } from '../quantity';
import type { Axis, ViewValues } from '../settings';
import { colourChoices, valuesOf } from '../view/colouring';
import type { VectorChoice } from '../view/vectors';
import { legend, unitOfField } from './legend';
import type { PlotList } from './plots';

// How the scene is looked at.
export function viewPanel(app: App, plots: PlotList): HTMLElement {
  return h(
    'aside',
    { className: 'side right' },
    section('Colour', 'colour', true, colourSection(app)),
    section('Show', 'show', true, showSection(app)),
    section('Slice', 'slice', true, sliceSection(app)),
    section('Particle', 'particle', true, particleSection(app)),
    section('Plots', 'plots', true, plots.element),
  );
}

function colourSection(app: App): HTMLElement {
  const select = h('select', { id: 'colour', aria: { label: 'Colour by' } });
  const refresh = (): void => {
    const scene = app.model.scene;
    if (!scene) return;
    const hasTexture = app.model.surfaces().some((body) => body.topology?.texture);
    const choices = colourChoices(scene, hasTexture);
    fill(select, ...choices.map(({ name, label }) => h('option', { value: name }, label)));
    if (!choices.some(({ name }) => name === app.settings.values.colour))
      app.settings.set('colour', '');
    select.value = app.settings.values.colour;
  };
  select.addEventListener('change', () => {
    app.settings.set('range', null);
    app.settings.set('colour', select.value);
  });
  app.model.on('scene', refresh);
  app.model.on('topology', (body) => {
    if (body.topology?.texture) refresh();
  });
  app.settings.on('changed', (name) => {
    if (name === 'colour') select.value = app.settings.values.colour;
  });
  return h('div', { className: 'stack' }, select, legend(app));
}

function check(
  app: App,
  name: keyof ViewValues &
    (
      | 'surface'
      | 'particles'
      | 'walls'
      | 'ghost'
      | 'context'
      | 'forces'
      | 'trueLength'
      | 'sliceFlip'
    ),
  text: string,
  title: string,
): HTMLLabelElement {
  const box = h('input', {
    type: 'checkbox',
    checked: app.settings.values[name],
    id: `show-${name}`,
  });
  box.addEventListener('change', () => app.settings.set(name, box.checked));
  app.settings.on('changed', (changed) => {
    if (changed === name) box.checked = app.settings.values[name];
  });
  return h('label', { className: 'check', title }, box, text);
}

function showSection(app: App): HTMLElement {
  const vectors = h(
    'select',
    { aria: { label: 'Vectors' } },
    h('option', { value: 'none' }, 'no vectors'),
    h('option', { value: 'displacement' }, 'displacement'),
    h('option', { value: 'velocity' }, 'velocity'),
  );
  vectors.addEventListener('change', () =>
    app.settings.set('vectors', vectors.value as VectorChoice),
  );
  const trueLength = check(app, 'trueLength', 'True length', 'Displacements as long as they are');
  app.settings.on('changed', () => {
    trueLength.hidden = app.settings.values.vectors !== 'displacement';
  });
  trueLength.hidden = true;
  const context = check(
    app,
    'context',
    'Eye behind the cornea',
    'Iris and eyeball, for context only',
  );
  app.model.on('scene', (scene) => {
    context.hidden = !scene.bodies.some((body) => /cornea/i.test(body.path));
  });
  return h(
    'div',
    { className: 'stack' },
    check(app, 'surface', 'Surface', 'The surface (S)'),
    check(app, 'particles', 'Particles', 'The particles that carry it (N)'),
    check(app, 'walls', 'Incision walls', 'Sides of incisions in a colour of their own'),
    check(app, 'ghost', 'Rest shape', 'The undeformed shape as a ghost (G)'),
    check(app, 'forces', 'Forces on tools', 'Force arrows and contact points (F)'),
    context,
    vectors,
    trueLength,
  );
}

function sliceSection(app: App): HTMLElement {
  const axis = h(
    'select',
    { aria: { label: 'Slice across' } },
    ...(['off', 'x', 'y', 'z'] as Axis[]).map((one) =>
      h('option', { value: one }, one === 'off' ? 'no slice' : `across ${one}`),
    ),
  );
  axis.addEventListener('change', () => app.settings.set('slice', axis.value as Axis));
  const at = h('input', {
    type: 'range',
    min: '0',
    max: '1',
    step: '0.002',
    value: '0.5',
    aria: { label: 'Place of the slice' },
  });
  at.addEventListener('input', () => app.settings.set('sliceAt', Number(at.value)));
  const flip = check(app, 'sliceFlip', 'Other side', 'Which side is shown');
  const refresh = (): void => {
    axis.value = app.settings.values.slice;
    at.hidden = flip.hidden = app.settings.values.slice === 'off';
  };
  app.settings.on('changed', refresh);
  refresh();
  return h('div', { className: 'stack' }, axis, at, flip);
}

// What is known of the picked particle.
function particleSection(app: App): HTMLElement {
  const facts = h('dl', { className: 'facts' });
  const note = h('p', { className: 'muted' });
  const refresh = (): void => {
    const { body, particle, ids } = app.stage.neighbourhood;
    if (!body?.position || particle < 0) {
      facts.hidden = true;
      setText(
        note,
        app.stage.particlesShown()
          ? 'With Orbit, click a particle to see its neighbours.'
          : 'Show particles, then click one to see its neighbours.',
      );
      return;
    }
    facts.hidden = false;
    const colour = app.settings.values.colour;
    const value = colour ? valuesOf(body, colour)?.[particle] : undefined;
    const unit = unitOfField(app, colour);
    const [x, y, z] = [0, 1, 2].map((k) => (1e3 * body.position![3 * particle + k]!).toFixed(3));
    fill(
      facts,
      h('dt', {}, 'Number'),
      h('dd', {}, String(particle)),
      h('dt', {}, 'Place (mm)'),
      h('dd', {}, `${x} ${y} ${z}`),
      h('dt', {}, 'Neighbours'),
      h('dd', {}, String(ids.length)),
      ...(value === undefined
        ? []
        : [h('dt', {}, colour), h('dd', {}, formatQuantity(value, unit))]),
    );
    setText(note, '');
  };
  app.model.on('frame', refresh);
  app.model.on('scene', refresh);
  app.settings.on('changed', refresh);
  document.addEventListener('stroma-picked', refresh);
  refresh();
  return h('div', { className: 'stack' }, facts, note);
}
