'use strict';
// Draws what a variation looks like at its end; the pointer turns it.
function drawPicture(canvas, picture) {
  // dark blue to yellow, as seen equally by those who confuse red and green (points of cividis)
  const ramp = [[0, 34, 78], [53, 69, 108], [102, 105, 112], [148, 142, 119], [200, 184, 102], [254, 232, 56]];
  const colours = Array.from({length: 256}, (_, i) => {
    const at = i / 255 * (ramp.length - 1), k = Math.min(Math.floor(at), ramp.length - 2);
    return ramp[k].map((part, c) => part + (at - k) * (ramp[k + 1][c] - part));
  });
  const n = picture.points.length / 3;
  const middle = [0, 1, 2].map(axis => {
    let low = Infinity, high = -Infinity;
    for (let i = 0; i < n; ++i) {
      low = Math.min(low, picture.points[3 * i + axis]);
      high = Math.max(high, picture.points[3 * i + axis]);
    }
    return (low + high) / 2;
  });
  let turn = -0.6, tilt = 0.45;
  const flat = new Float32Array(3 * n);
  function project(width, height) {
    const [cz, sz, ct, st] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    const scale = Math.min(width, height * 1.35) / 1150;
    for (let i = 0; i < n; ++i) {
      const [x, y, z] = [0, 1, 2].map(axis => picture.points[3 * i + axis] - middle[axis]);
      const across = cz * x - sz * y, away = sz * x + cz * y;
      flat[3 * i] = width / 2 + scale * across;
      flat[3 * i + 1] = height / 2 - scale * (ct * z + st * away);
      flat[3 * i + 2] = ct * away - st * z;
    }
  }
  function colourOf(value, light) {
    const [r, g, b] = colours[value].map(part => Math.round(Math.min(255, part * light)));
    return `rgb(${r},${g},${b})`;
  }
  function drawTriangles(context) {
    const t = picture.triangles, faces = [];
    for (let k = 0; k < t.length; k += 3) {
      faces.push([flat[3 * t[k] + 2] + flat[3 * t[k + 1] + 2] + flat[3 * t[k + 2] + 2], k]);
    }
    faces.sort((a, b) => b[0] - a[0]);
    for (const [, k] of faces) {
      const [a, b, c] = [t[k], t[k + 1], t[k + 2]];
      const [ux, uy, uz] = [0, 1, 2].map(i => flat[3 * b + i] - flat[3 * a + i]);
      const [vx, vy, vz] = [0, 1, 2].map(i => flat[3 * c + i] - flat[3 * a + i]);
      const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      const light = 0.75 + 0.35 * Math.abs(normal[2]) / (Math.hypot(...normal) || 1);
      const value = Math.round((picture.colours[a] + picture.colours[b] + picture.colours[c]) / 3);
      context.fillStyle = context.strokeStyle = colourOf(value, light);
      context.beginPath();
      context.moveTo(flat[3 * a], flat[3 * a + 1]);
      context.lineTo(flat[3 * b], flat[3 * b + 1]);
      context.lineTo(flat[3 * c], flat[3 * c + 1]);
      context.closePath();
      context.fill();
      context.stroke();
    }
  }
  function drawPoints(context) {
    const order = Array.from({length: n}, (_, i) => i).sort((a, b) => flat[3 * b + 2] - flat[3 * a + 2]);
    for (const i of order) {
      context.fillStyle = colourOf(picture.colours[i], 1);
      context.fillRect(flat[3 * i] - 2, flat[3 * i + 1] - 2, 4, 4);
    }
  }
  function draw() {
    const ratio = window.devicePixelRatio || 1;
    canvas.width = canvas.clientWidth * ratio;
    canvas.height = canvas.clientHeight * ratio;
    const context = canvas.getContext('2d');
    context.lineWidth = 0.6 * ratio;
    project(canvas.width, canvas.height);
    picture.triangles.length > 0 ? drawTriangles(context) : drawPoints(context);
  }
  canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', event => {
    if (!event.buttons) return;
    turn += event.movementX / 80;
    tilt = Math.max(-1.57, Math.min(1.57, tilt + event.movementY / 80));
    draw();
  });
  draw();
}
