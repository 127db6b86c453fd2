'use strict';
// Builds the report from the study's summary (results.json). Texts reach the page as text only.
(() => {
  const summary = JSON.parse(document.getElementById('data').textContent);
  const pictures = JSON.parse(document.getElementById('pictures').textContent);
  const style = getComputedStyle(document.documentElement);
  const css = name => style.getPropertyValue(name).trim();
  // Okabe and Ito's colours, which stay apart for everybody; every method has its own marker, too
  const palette = ['#0072b2', '#e69f00', '#009e73', '#d55e00', '#cc79a7', '#56b4e9', '#8c7a00', css('--quiet')];
  // from the ninth method on, colours come back with other markers
  const markers = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot', 'rectRounded', 'cross'];
  const colourOf = m => palette[m % palette.length];
  const markerOf = m => markers[(m + 3 * Math.floor(m / palette.length)) % markers.length];
  Chart.defaults.color = css('--ink');
  Chart.defaults.borderColor = css('--line');
  Chart.defaults.font.family = 'system-ui, "DejaVu Sans", sans-serif';
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;

  const number = value => value === null || value === undefined ? '–' : Number(value.toPrecision(4)).toString();
  const percent = value => value === null || value === undefined ? '–' : Number((100 * value).toPrecision(3)) + ' %';
  function make(tag, text, parent, className) {
    const element = document.createElement(tag);
    if (text !== null) element.textContent = text;
    if (className) element.className = className;
    if (parent) parent.appendChild(element);
    return element;
  }

  // Bounds of an axis a little beyond all values; lines of budgets run across.
  function bounds(values) {
    const good = values.filter(v => v > 0);
    if (good.length === 0) return [0.1, 1];
    return [Math.min(...good) / 1.6, Math.max(...good) * 1.6];
  }
  function logAxis(title, range, show) {
    return {
      type: 'logarithmic', min: range[0], max: range[1], title: {display: true, text: title},
      ticks: {
        maxRotation: 0, autoSkipPadding: 12,
        callback: value => {
          const leading = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
          const wanted = range[1] / range[0] > 300 ? [1] : [1, 2, 5];
          return wanted.some(digit => Math.abs(leading - digit) < 1e-6) ? show(value) : '';
        },
      },
    };
  }
  const line = (label, data, colour, dash, width) => ({
    label, data, type: 'line', borderColor: colour, borderDash: dash, borderWidth: width, pointRadius: 0,
    pointHitRadius: 0, pointStyle: 'line', isGuide: true,
  });
  // One dataset for each series: markers, joined where they differ in size only.
  function seriesSets(question, point) {
    return question.series.map(series => {
      const m = question.methods.indexOf(series.method);
      const rows = series.rows.map(i => question.rows[i]);
      const joined = rows.every(row => row.h !== null);
      const data = rows.map(row => ({...point(row), row})).filter(p => p.x > 0 && p.y > 0);
      if (joined) data.sort((a, b) => a.row.h - b.row.h);
      return {
        label: series.name, data, showLine: joined, borderColor: colourOf(m),
        backgroundColor: colourOf(m), pointStyle: markerOf(m), pointRadius: 6,
        pointBorderWidth: 2, pointHoverRadius: 8, borderWidth: 1.5, series,
      };
    });
  }
  let pointCount = 0;
  function plot(parent, caption, datasets, scales) {
    const shown = datasets.filter(set => set.data.length > 0);
    const points = shown.filter(set => !set.isGuide).reduce((sum, set) => sum + set.data.length, 0);
    if (points === 0) return;
    const figure = make('figure', null, parent);
    make('figcaption', caption, figure);
    const canvas = make('canvas', null, make('div', null, figure, 'plot'));
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', caption + ': the figures are in the table below');
    canvas.dataset.points = points;
    pointCount += points;
    new Chart(canvas, {
      type: 'scatter', data: {datasets: shown},
      options: {
        scales,
        plugins: {
          legend: {position: 'bottom', labels: {usePointStyle: true, boxHeight: 7, padding: 10}},
          tooltip: {
            callbacks: {
              label: item => item.raw.row
                ? `${item.raw.row.label}: ${percent(item.raw.row.error)} error, ${number(item.raw.row.cost_ms)} ms`
                : item.dataset.label,
            },
          },
        },
      },
    });
  }

  function errorAgainstCost(question, parent) {
    const cost = question.cost === 'run' ? 'ms for the whole run' : 'ms a step';
    const sets = seriesSets(question, row => ({x: row.cost_ms, y: row.error}));
    const all = sets.flatMap(set => set.data);
    const published = question.published;
    const x = bounds(all.map(p => p.x).concat(published.map(p => p.ms), question.budgets.ms));
    const y = bounds(all.map(p => p.y).concat(published.map(p => p.error || 0), question.budgets.error));
    const front = question.pareto.map(i => ({x: question.rows[i].cost_ms, y: question.rows[i].error}));
    if (front.length > 0) {
      const ends = [{x: front[0].x, y: y[1]}, ...front, {x: x[1], y: front[front.length - 1].y}];
      sets.push({...line('nobody better in both', ends, css('--quiet'), [], 1), stepped: 'before'});
    }
    for (const p of published) {
      const label = `${p.name} (published)`;
      sets.push(p.error
        ? {label, data: [{x: p.ms, y: p.error}], pointStyle: 'star', pointRadius: 9, borderColor: css('--ink'), isGuide: true}
        : line(label, [{x: p.ms, y: y[0]}, {x: p.ms, y: y[1]}], css('--ink'), [1, 3], 2));
    }
    for (const e of question.budgets.error) {
      sets.push(line(`${percent(e)} error`, [{x: x[0], y: e}, {x: x[1], y: e}], css('--quiet'), [6, 4], 1));
    }
    for (const ms of question.budgets.ms) {
      sets.push(line(`${number(ms)} ${cost}`, [{x: ms, y: y[0]}, {x: ms, y: y[1]}], css('--quiet'), [2, 3], 1));
    }
    plot(parent, 'Error against time: lower left is better', sets,
      {x: logAxis(cost, x, v => number(v)), y: logAxis(`error of ${question.measures[0].name}`, y, percent)});
  }

  function errorAgainstRealTime(question, parent) {
    const sets = seriesSets(question, row => ({x: row.real_time_factor, y: row.error}));
    const all = sets.flatMap(set => set.data);
    const x = bounds(all.map(p => p.x).concat([1])), y = bounds(all.map(p => p.y));
    sets.push(line('real time', [{x: 1, y: y[0]}, {x: 1, y: y[1]}], css('--quiet'), [6, 4], 1));
    plot(parent, 'Error against speed: lower right is better', sets, {
      x: logAxis('simulated time over computing time', x, v => number(v)),
      y: logAxis(`error of ${question.measures[0].name}`, y, percent),
    });
  }

  function convergence(question, parent) {
    const sets = seriesSets(question, row => ({x: row.h, y: row.error})).filter(set => set.data.length > 1);
    if (sets.length === 0) return;
    for (const set of sets) {
      if (set.series.order !== null) set.label += `: order ${set.series.order.toFixed(2)}`;
    }
    const all = sets.flatMap(set => set.data);
    plot(parent, 'Convergence (order fitted to the three finest)', sets, {
      x: logAxis('size h (SI)', bounds(all.map(p => p.x)), v => number(v)),
      y: logAxis(`error of ${question.measures[0].name}`, bounds(all.map(p => p.y)), percent),
    });
  }

  function stages(question, parent) {
    const rows = question.rows.filter(row => row.stages);
    if (rows.length === 0) return;
    const names = [...new Set(rows.flatMap(row => Object.keys(row.stages)))];
    const figure = make('figure', null, parent);
    make('figcaption', 'Where the time of a step goes', figure);
    const frame = make('div', null, figure, 'plot');
    frame.style.height = `${Math.max(12, 4 + 1.5 * rows.length)}rem`;
    const canvas = make('canvas', null, frame);
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'Time of each stage of a step, for every variation');
    new Chart(canvas, {
      type: 'bar',
      data: {
        labels: rows.map(row => row.label),
        datasets: names.map((name, i) => ({
          label: name, data: rows.map(row => row.stages[name] || 0), backgroundColor: palette[i % palette.length],
        })),
      },
      options: {
        indexAxis: 'y',
        scales: {x: {stacked: true, title: {display: true, text: 'ms a step (wall time)'}}, y: {stacked: true}},
        plugins: {legend: {position: 'bottom'}},
      },
    });
  }

  function gallery(question, parent) {
    const rows = question.rows.filter(row => pictures[row.id]);
    if (rows.length === 0) return;
    make('h3', 'How each ends (drag to turn; yellow moved farthest)', parent);
    const box = make('div', null, parent, 'pictures');
    for (const row of rows) {
      const figure = make('figure', null, box), canvas = make('canvas', null, figure);
      const moved = number(1e3 * pictures[row.id].largest);
      canvas.setAttribute('role', 'img');
      canvas.setAttribute('aria-label', `${row.label}, moved by at most ${moved} mm`);
      make('figcaption', `${row.label} (up to ${moved} mm)`, figure);
      drawPicture(canvas, pictures[row.id]);
    }
  }

  function notesOf(row) {
    const notes = [];
    if (row.message) notes.push(row.message);
    for (const [name, value] of Object.entries(row.values || {})) {
      if (value.problem) notes.push(`${name}: ${value.problem}`);
    }
    if (row.repeats_agree === false) notes.push('repeated runs did not end with the same bits');
    if (row.ms_per_step && row.ms_per_step.runs === 1) notes.push('timed once: no spread');
    if (row.processor && row.processor !== summary.machine.processor) notes.push(`timed on ${row.processor}`);
    if (row.side_by_side > 1) notes.push(`timed beside ${row.side_by_side - 1} other`);
    for (const [name, count] of Object.entries(row.limiters || {})) notes.push(`${name} ${count}×`);
    return notes.join('; ');
  }

  function table(question, parent) {
    make('h3', 'All figures', parent);
    const body = make('table', null, make('div', null, parent, 'scroll'));
    const head = make('tr', null, make('thead', null, body));
    const titles = ['variation', 'status'];
    for (const m of question.measures) {
      if (m.kind !== 'field') titles.push(m.name);
      titles.push(`${m.name}: error`);
    }
    titles.push('ms a step', 'min … max', 'p99');
    if (question.cost === 'run') titles.push('ms for the run');
    titles.push('× real time', 'steps', 'particles', 'load ms', 'MB', 'notes');
    for (const title of titles) make('th', title, head, title === 'notes' ? 'text' : '').scope = 'col';
    const rows = make('tbody', null, body);
    question.rows.forEach((row, i) => {
      const tr = make('tr', null, rows, question.pareto.includes(i) ? 'front' : '');
      tr.dataset.id = row.id;
      make('td', row.label, tr);
      make('td', row.status, tr, row.status === 'done' ? 'good' : 'bad');
      for (const m of question.measures) {
        const value = (row.values || {})[m.name] || {};
        const error = value.signed_error === undefined ? value.error : value.signed_error;
        if (m.kind !== 'field') make('td', number(value.value), tr);
        make('td', percent(error), tr);
      }
      const ms = row.ms_per_step;
      make('td', ms ? number(ms.median) : '–', tr);
      make('td', ms ? `${number(ms.min)} … ${number(ms.max)}` : '–', tr);
      make('td', ms ? number(ms.p99) : '–', tr);
      if (question.cost === 'run') make('td', number(row.cost_ms), tr);
      for (const key of ['real_time_factor', 'steps', 'particles', 'load_ms', 'peak_memory_mb']) {
        make('td', number(row[key]), tr);
      }
      make('td', notesOf(row), tr, 'text');
    });
    for (const p of question.published) {
      const tr = make('tr', null, rows);
      make('td', p.name, tr);
      make('td', 'published', tr);
      for (const m of question.measures) {
        if (m.kind !== 'field') make('td', '–', tr);
        make('td', m === question.measures[0] ? percent(p.error) : '–', tr);
      }
      make('td', number(p.ms), tr);
      const rest = titles.length - tr.children.length - 1;
      for (let k = 0; k < rest; ++k) make('td', '–', tr);
      make('td', p.source, tr, 'text');
    }
    make('p', 'Values are in SI units. Bold: nobody is better in both error and time.', parent, 'note');
    for (const m of question.measures.flatMap(one => [one, ...(one.others || [])])) {
      const against = m.reference === null ? 'not compared'
        : typeof m.reference === 'number' ? `compared with ${number(m.reference)}`
        : m.reference === 'displacements' ? 'compared with given displacements' : `compared with the run ${m.reference}`;
      const whose = m.methods.length > 0 ? `, of ${m.methods.join('; ')}` : '';
      make('p', `${m.name}${whose}: ${against}${m.source ? ` (${m.source})` : ''}.`, parent, 'note');
    }
    for (const r of question.references) {
      const ran = r.status === 'done' ? `${number(r.particles)} particles, ${number(r.steps)} steps` : `${r.status} ${r.message}`;
      make('p', `Reference run ${r.method}: ${ran}.`, parent, 'note');
    }
  }

  const main = document.getElementById('questions');
  for (const question of summary.questions) {
    const section = make('section', null, main);
    if (question.name) make('h2', question.name, section);
    if (question.text) make('p', question.text, section, 'lead');
    const answers = make('ul', null, section, 'answers');
    for (const sentence of question.sentences) make('li', sentence, answers);
    const plots = make('div', null, section, 'plots');
    errorAgainstCost(question, plots);
    errorAgainstRealTime(question, plots);
    convergence(question, plots);
    stages(question, plots);
    gallery(question, section);
    table(question, section);
  }
  const m = summary.machine;
  const footer = document.getElementById('machine');
  make('p', `${m.processor}, ${m.cores} cores${m.governor ? `, governor ${m.governor}` : ''}; ${m.system}; ${m.compiler}, ` +
    `${m.build} build; ${m.date}; load ${m.load.map(number).join(' ')}. Stroma ${m.version}.`, footer);
  make('p', 'Each variation ran in a process of its own, tied to a core of its own. The time of a step is the median over ' +
    'repeated runs (a first one to warm up is left out) of the mean over a run\'s steps; beside it the least and the ' +
    'largest of these means, and the 99th percentile of single steps.', footer);
  document.documentElement.dataset.points = pointCount;
})();
