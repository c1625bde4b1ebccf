// The curves below the mechanism: one diagram for each group of quantities, chosen by tabs.

const CURVE_COLORS = { light: ['#0072b2', '#d55e00', '#009e73', '#b87a00', '#b5588f', '#3d8fc4'], dark: ['#56b4e9', '#ff9a56', '#2fcfa0', '#f0b440', '#e49ac4', '#8fd0f5'] };

/** Makes the tabs and the first diagram. `page` has `t`, `seek(t)` and `isDark()`. */
function buildCurves(page, data, times) {
  const curves = data.curves.map((curve) => ({ ...curve, values: gaps(floats(curve.values)), bar: gaps(floats(curve.bar)) }));
  const groups = [...new Set(curves.map((curve) => curve.group))];
  const state = { page, times: Array.from(times), curves, plot: null, group: groups[0] };
  if (!groups.length || times.length < 2) {
    byId('curves').style.display = 'none';
    return state;
  }
  groups.forEach((group) => {
    const tab = document.createElement('button');
    tab.textContent = group;
    tab.onclick = () => showGroup(state, group);
    byId('tabs').append(tab);
  });
  showGroup(state, groups[0]);
  return state;
}

/** Values that are not numbers make gaps. */
function gaps(numbers) {
  return Array.from(numbers, (value) => (Number.isFinite(value) ? value : null));
}

function showGroup(state, group) {
  state.group = group;
  for (const tab of byId('tabs').children) tab.classList.toggle('on', tab.textContent === group);
  drawCurves(state);
}

/** Draws the diagram of the chosen group anew. */
function drawCurves(state) {
  if (state.plot) state.plot.destroy();
  const shown = state.curves.filter((curve) => curve.group === state.group);
  const colors = CURVE_COLORS[state.page.isDark() ? 'dark' : 'light'];
  const series = [{ label: 't', value: (_, t) => clockText(t) }];
  const columns = [state.times];
  const bands = [];
  const sides = {};
  shown.forEach((curve, k) => {
    const own = series.length;
    const color = colors[k % colors.length];
    series.push({ label: curve.name, stroke: color, width: 1.6, value: (_, value) => number(value, curve.unit) });
    columns.push(curve.values);
    if (curve.bar.some((bar) => bar !== null)) sides[own] = addBar(curve, color, series, columns, bands);
  });
  // A band is shown with its curve, and has no name of its own.
  const setSeries = (plot, own, { show }) => (sides[own] || []).forEach((side) => plot.setSeries(side, { show }));
  state.plot = new L.uPlot({ ...plotSize(), series, bands, hooks: { setSeries: [setSeries] }, ...plotLook(state, shown) }, columns, byId('plot'));
  const names = state.plot.root.querySelectorAll('.u-legend .u-series');
  Object.values(sides).flat().forEach((side) => { names[side].style.display = 'none'; });
  state.cursor = document.createElement('div');
  state.cursor.className = 'now';
  state.plot.over.append(state.cursor);
  seekByPointer(state);
  // uPlot lays itself out after this.
  state.page.changed = true;
}

/** Adds the band of an error bar: two thin curves around it; returns their numbers. */
function addBar(curve, color, series, columns, bands) {
  for (const sign of [1, -1]) {
    const side = curve.values.map((value, i) => (value === null || curve.bar[i] === null ? null : value + sign * curve.bar[i]));
    series.push({ stroke: color, width: 0.5, points: { show: false } });
    columns.push(side);
  }
  const sides = [series.length - 2, series.length - 1];
  bands.push({ series: sides, fill: `${color}44` });
  return sides;
}

function plotSize() {
  return { width: byId('plot').clientWidth, height: Math.max(110, Math.min(170, Math.round(innerHeight * 0.2))) };
}

function plotLook(state, shown) {
  const isDark = state.page.isDark();
  const ink = isDark ? '#b9c4d2' : '#46505d';
  const grid = { stroke: isDark ? '#28313d' : '#e4e8ee', width: 1 };
  const axis = { stroke: ink, grid, ticks: grid, font: '12px system-ui, sans-serif' };
  const isLog = shown.some((curve) => curve.is_log);
  return {
    cursor: { drag: { x: false, y: false }, points: { size: 5 } },
    legend: { live: true },
    scales: { x: { time: false }, y: isLog ? { distr: 3 } : { range: (_, low, high) => room(low, high) } },
    axes: [{ ...axis, size: 30, values: (_, ticks) => ticks.map((t, i) => (i === ticks.length - 1 ? `${short(t)} s` : short(t))) }, { ...axis, size: 68, values: (_, ticks) => ticks.map((y) => (y === null || y === undefined ? '' : short(y))) }],
  };
}

/** A range with some room; for a constant, around it. */
function room(low, high) {
  if (low === null || high === null) return [0, 1];
  const size = high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)) ? high - low : Math.abs(high) || 1;
  return [low - 0.06 * size, high + 0.06 * size];
}

/** A click, or a drag, goes to its time. */
function seekByPointer(state) {
  const { over } = state.plot;
  const seek = (event) => {
    const x = event.clientX - over.getBoundingClientRect().left;
    state.page.seek(state.plot.posToVal(x, 'x'));
  };
  over.addEventListener('pointerdown', (event) => {
    over.setPointerCapture(event.pointerId);
    seek(event);
  });
  over.addEventListener('pointermove', (event) => {
    if (over.hasPointerCapture(event.pointerId)) seek(event);
  });
}

/** Moves the cursor to the present time, and the legend to the values there. */
function moveCursor(state) {
  if (!state.plot) return;
  const { t } = state.page;
  state.cursor.style.transform = `translateX(${state.plot.valToPos(t, 'x')}px)`;
  const [a, b, part] = bracket(state.times, t);
  state.plot.setLegend({ idx: part < 0.5 ? a : b }, false);
}

/** A number with as many digits as one reads. */
function short(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
    const [digits, exponent] = value.toExponential(2).split('e');
    return `${Number(digits)}e${Number(exponent)}`.replace(/-/g, '−');
  }
  return String(Number(value.toPrecision(4))).replace('-', '−');
}

function number(value, unit) {
  return value === null || value === undefined ? '–' : `${short(value)} ${unit.includes(',') || unit.includes(';') ? '' : unit}`;
}
