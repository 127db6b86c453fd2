// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { sliderScale } from '../src/panels/slider_scale';
import type { Attribute } from '../src/protocol';
import { formatQuantity, parseQuantity, quantityText } from '../src/quantity';

test('textsBecomeSiNumbers', () => {
  assert.equal(parseQuantity('0.5 MPa', 'Pa'), 5e5);
  assert.equal(parseQuantity('3mm', 'm'), 3e-3);
  assert.equal(parseQuantity('1000 N/m', 'N/m'), 1000);
  assert.equal(parseQuantity('1e-3', 's'), 1e-3);
  assert.equal(parseQuantity('20 g', 'kg'), 0.02);
  assert.ok(Number.isNaN(parseQuantity('1 2 3', 'm')));
  assert.ok(Number.isNaN(parseQuantity('5 furlongs', 'm')));
});

test('numbersAreShownInFittingUnits', () => {
  assert.equal(formatQuantity(5e5, 'Pa'), '500 kPa');
  assert.equal(formatQuantity(6.5e-4, 'm'), '650 µm');
  assert.equal(formatQuantity(0, 'N'), '0 N');
  assert.equal(formatQuantity(1062, 'kg/m^3'), '1062 kg/m^3');
});

test('whatIsShownIsReadBack', () => {
  for (const value of [1e-9, 3.21e-5, 0.02, 1, 47, 5e5, 2.5e9]) {
    assert.ok(Math.abs(parseQuantity(formatQuantity(value, 'Pa', 7), 'Pa') / value - 1) < 1e-6);
    assert.ok(Math.abs(parseQuantity(quantityText(value, 'Pa'), 'Pa') / value - 1) < 1e-6);
  }
});

const modulus: Attribute = {
  name: 'youngModulus',
  type: 'number',
  unit: 'Pa',
  value: '500000',
  default: '10000',
  min: 0,
  exclusiveMin: true,
};

test('slidersOverDecadesAreLogarithmic', () => {
  const scale = sliderScale(modulus, 5e5)!;
  assert.ok(scale.low <= 1e4 && scale.high >= 5e5);
  const ratio = scale.value(0.5) / scale.value(0.25);
  assert.ok(Math.abs(scale.value(0.75) / scale.value(0.5) / ratio - 1) < 1e-9);
  for (const x of [1e4, 7e4, 5e5]) assert.ok(Math.abs(scale.value(scale.place(x)) / x - 1) < 1e-9);
});

test('slidersKeepTheDeclaredRange', () => {
  const ratio: Attribute = {
    name: 'poissonRatio',
    type: 'number',
    value: '0.45',
    default: '0.33',
    min: -1,
    max: 0.5,
  };
  const scale = sliderScale(ratio, 0.45)!;
  assert.equal(scale.value(0), -1);
  assert.equal(scale.value(1), 0.5);
  assert.equal(sliderScale({ name: 'x', type: 'number', value: '' }, NaN), null);
});
