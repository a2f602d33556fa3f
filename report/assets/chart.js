// Draws the charts of the data block: zoom by dragging or by keys, values under the cursor, time axes that move together.
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  rigproof.data = data;
  rigproof.charts = {};
  const { colour } = rigproof;
  const signs = '−';
  const digits = (value, count) => {
    if (value === null || value === undefined || !Number.isFinite(value)) return '–';
    const size = Math.abs(value);
    const text = value === 0 || (size >= 1e-3 && size < 1e6) ? String(Number(value.toPrecision(count))) : value.toExponential(count - 1);
    return text.replace('-', signs);
  };
  rigproof.digits = digits;
  const unit = (axis) => (axis.unit && axis.unit !== '1' ? ` ${axis.unit}` : '');
  const label = (axis) => (axis.unit && axis.unit !== '1' ? `${axis.label} (${axis.unit})` : axis.label);

  // The marked stretches and the band of noise, below the curves.
  const marks = (spec) => (u) => {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    for (const span of spec.spans) {
      const left = u.valToPos(span.from, 'x', true);
      const right = u.valToPos(span.to, 'x', true);
      ctx.fillStyle = colour(span.role);
      ctx.fillRect(left, bbox.top, Math.max(right - left, 1.5 * devicePixelRatio), bbox.height);
    }
    if (spec.band) {
      const top = u.valToPos(spec.band[1], 'y', true);
      const bottom = u.valToPos(Math.max(spec.band[0], u.scales.y.min), 'y', true);
      ctx.globalAlpha = 0.22;
      ctx.fillStyle = colour('noise');
      ctx.fillRect(bbox.left, top, bbox.width, bottom - top);
    }
    ctx.restore();
  };

  const series = (spec, own) => {
    const line = { label: own.name, stroke: () => colour(own.role), width: own.width, value: (u, v) => (v === null ? '–' : digits(v, 5) + unit(spec.y)) };
    if (own.dashed) line.dash = [7, 4];
    if (own.kind === 'bars') {
      line.paths = uPlot.paths.bars({ size: [0.92, 200], align: 0 });
      line.fill = () => colour(own.role) + '55';
    }
    line.points = { show: own.kind === 'points', size: 6 };
    line.spanGaps = false;
    return line;
  };

  const range = (spec) => (u, low, high) => {
    if (low === null || high === null) return spec.log_y ? [0.1, 10] : [0, 1];
    if (spec.log_y) return [0.8 * Math.min(low, 0.8), 1.3 * Math.max(high, 1.2)];
    if (spec.limits) {
      low = Math.max(low, spec.limits[0]);
      high = Math.min(high, spec.limits[1]);
    }
    if (spec.band) {
      low = Math.min(low, 1.25 * spec.band[0]);
      high = Math.max(high, 1.25 * spec.band[1]);
    }
    if (spec.from_zero) low = Math.min(low, 0);
    if (!(high > low)) { low -= 1; high += 1; }
    const room = 0.05 * (high - low);
    return [spec.from_zero && low === 0 ? 0 : low - room, high + room];
  };

  const axis = (own, size) => ({
    label: label(own), labelSize: 20, size, gap: 4, font: '12px system-ui, sans-serif', labelFont: '13px system-ui, sans-serif',
    stroke: () => colour('ink'), grid: { stroke: () => colour('line'), width: 1 }, ticks: { stroke: () => colour('line'), width: 1 },
    values: (u, values) => values.map((value) => (value === null ? '' : digits(value, 4))),
  });

  let leading = null;
  // Only what somebody does moves the others: a chart that is being made shows all of its own.
  const follow = (spec) => (u, key) => {
    if (key !== 'x' || leading || !spec.sync || !rigproof.charts[spec.id]?.ready) return;
    leading = u;
    for (const other of Object.values(rigproof.charts)) {
      if (other.plot !== u && other.spec.sync === spec.sync) other.plot.setScale('x', { min: u.scales.x.min, max: u.scales.x.max });
    }
    leading = null;
  };

  const width = (place) => (rigproof.printing ? Math.min(place.clientWidth, 680) : place.clientWidth);
  const make = (spec) => {
    const place = document.getElementById(`plot-${spec.id}`);
    const options = {
      width: width(place), height: spec.height,
      scales: { x: { time: false }, y: { range: range(spec), distr: spec.log_y ? 3 : 1 } },
      axes: [axis(spec.x, 44), axis(spec.y, 68)],
      series: [{ label: spec.x.label, value: (u, v) => (v === null ? '–' : digits(v, 6) + unit(spec.x)) }, ...spec.series.map((own) => series(spec, own))],
      cursor: { sync: spec.sync ? { key: spec.sync } : undefined, drag: { x: true, y: false }, focus: { prox: 24 } },
      legend: { live: true },
      hooks: { drawClear: [marks(spec)], setScale: [follow(spec)] },
    };
    if (spec.what_if) spec.series[spec.what_if.curve].v = leftWithout(spec.what_if, []);
    const plot = new uPlot(options, [spec.t, ...spec.series.map((own) => own.v)], place);
    const own = { plot, spec, ready: false };
    rigproof.charts[spec.id] = own;
    requestAnimationFrame(() => { own.ready = true; });
    const resize = () => plot.setSize({ width: width(place), height: spec.height });
    new ResizeObserver(() => { if (Math.abs(plot.width - width(place)) > 1) resize(); }).observe(place);
    const markers = () => place.querySelectorAll('.u-marker').forEach((own, k) => { if (k > 0) own.style.borderColor = colour(spec.series[k - 1].role); });
    rigproof.redraw.push(() => { markers(); if (rigproof.printing || plot.width !== width(place)) resize(); plot.redraw(false, true); });
    controls(spec, plot, place);
    if (spec.what_if) whatIf(spec, plot);
  };

  // What would be left over without the names that are switched off: a quadratic form of products that the page holds, stretch by stretch. A weight of 1 is off.
  const squaresWithout = ({ products }, off) => products.map((own) => {
    const weights = [1, ...off];
    let [sum, k] = [0, 0];
    weights.forEach((one, i) => {
      for (let j = 0; j <= i; j += 1, k += 1) sum += (i === j ? 1 : 2) * one * weights[j] * own[k];
    });
    return Math.max(sum, 0);
  });
  const leftWithout = (own, off) => squaresWithout(own, off).map((x, k) => (own.counts[k] > 0 ? Math.sqrt(x) / own.floor : null));

  const whatIf = (spec, plot) => {
    const { what_if: own } = spec;
    const boxes = [...document.querySelectorAll(`[data-what-if="${spec.id}"]`)];
    const said = document.getElementById(`what-if-${spec.id}`);
    const say = () => {
      const off = boxes.map((box) => (box.checked ? 0 : 1));
      const windows = own.counts.reduce((sum, count) => sum + count, 0);
      const whole = Math.sqrt(squaresWithout(own, off).reduce((sum, x, k) => sum + x * own.counts[k], 0) / windows) / own.floor;
      said.textContent = `${off.includes(1) ? 'Without what is switched off' : 'With all of it'} the new model leaves ${digits(whole, 3)} times the noise here.`;
      return off;
    };
    const switched = () => {
      spec.series[own.curve].v = leftWithout(own, say());
      plot.setData([spec.t, ...spec.series.map((one) => one.v)], false);
      plot.redraw();
    };
    for (const box of boxes) box.addEventListener('change', switched);
    say();
  };

  // Zoom and move by keys and buttons, for hands that hold no mouse.
  const controls = (spec, plot, place) => {
    const [first, last] = [spec.t[0], spec.t[spec.t.length - 1]];
    const view = (factor, shift) => {
      const { min, max } = plot.scales.x;
      const half = Math.min((factor * (max - min)) / 2, (last - first) / 2);
      const middle = Math.min(Math.max((min + max) / 2 + shift * (max - min), first + half), last - half);
      plot.setScale('x', { min: middle - half, max: middle + half });
    };
    const doing = { in: () => view(0.5, 0), out: () => view(2, 0), left: () => view(1, -0.25), right: () => view(1, 0.25), whole: () => plot.setScale('x', { min: first, max: last }) };
    const keys = { '+': 'in', '=': 'in', '-': 'out', ArrowLeft: 'left', ArrowRight: 'right', 0: 'whole' };
    place.addEventListener('keydown', (event) => {
      const what = keys[event.key];
      if (!what || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      doing[what]();
    });
    for (const button of document.querySelectorAll(`[data-chart="${spec.id}"]`)) {
      const what = button.dataset.do;
      button.addEventListener('click', () => {
        if (what === 'csv') csv(spec);
        else if (what === 'svg') rigproof.saveSvg(spec.id, rigproof.chartSvg(plot, spec));
        else doing[what]();
      });
    }
  };

  const csv = (spec) => {
    const head = [label(spec.x), ...spec.series.map((own) => `${own.name} (${spec.y.unit})`)];
    rigproof.saveCsv(spec.id, [head, ...spec.t.map((t, k) => [t, ...spec.series.map((own) => own.v[k])])]);
  };

  // What is folded up has no width yet: it is made when it is opened.
  for (const spec of data.charts) {
    const fold = document.getElementById(`plot-${spec.id}`).closest('details:not([open])');
    if (fold) fold.addEventListener('toggle', () => make(spec), { once: true });
    else make(spec);
  }
})();
