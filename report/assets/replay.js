// Plays what moves: the recording, and the old and the new model beside it.
(() => {
  const { replay } = rigproof.data;
  if (!replay) return;
  const drawing = document.getElementById('replay-drawing');
  const slider = document.getElementById('replay-time');
  const play = document.getElementById('replay-play');
  const said = document.getElementById('replay-said');
  const speed = document.getElementById('replay-speed');
  const times = document.getElementById('replay-times');
  const last = replay.time_s.length - 1;
  const { digits } = rigproof;
  const named = (name) => drawing.querySelector(`[data-linkage="${name}"]`);
  // y points away from the base, up on the screen.
  const points = (flat) => flat.map(([x, y]) => `${x},${-y}`).join(' ');
  const [left, , width, height] = drawing.getAttribute('viewBox').split(' ').map(Number);
  // How each shape is drawn from the numbers of a frame: its arms, its tip, and how far the tips of two frames are apart.
  const shape = {
    linkage: {
      arms: ([ex, ey, dx, dy, cx, cy]) => [replay.a, [ex, ey], [dx, dy], [cx, cy], replay.b],
      tip: ([, , dx, dy]) => [dx, dy],
      apart: (one, other) => [1e3 * Math.hypot(one[2] - other[2], one[3] - other[3]), 'mm off at the tip'],
      columns: [['tip x', 'm', 2], ['tip y', 'm', 3]],
    },
    turning: {
      arms: ([angle]) => [replay.a, [Math.cos(angle), Math.sin(angle)]],
      tip: ([angle]) => [Math.cos(angle), Math.sin(angle)],
      apart: (one, other) => [Math.abs(one[0] - other[0]), 'rad off'],
      columns: [['angle', 'rad', 0]],
    },
    sliding: {
      arms: ([x]) => [[x, 0.4 * height], [x, -0.4 * height]],
      tip: ([x]) => [Math.min(Math.max(x, left), left + width), 0],
      apart: (one, other) => [1e3 * Math.abs(one[0] - other[0]), 'mm off'],
      columns: [['position', 'm', 0]],
    },
  }[replay.shape];
  const trail = (way, k) => {
    const from = Math.max(0, k - 25);
    return way.frames.slice(from, k + 1).map((_, i) => drawn(way, from + i)).filter((f) => f).map(shape.tip);
  };
  // A model as far from the recording as it is, or twenty times as far; the recording stays where it was.
  const drawn = (way, k) => {
    const [frame, recorded] = [way.frames[k], replay.ways[0].frames[k]];
    return frame && recorded ? frame.map((x, i) => recorded[i] + Number(times.value) * (x - recorded[i])) : frame;
  };

  const show = (k) => {
    for (const way of replay.ways) {
      const frame = drawn(way, k);
      const group = named(way.role);
      group.style.visibility = frame ? 'visible' : 'hidden';
      if (!frame) continue;
      const [dx, dy] = shape.tip(frame);
      group.querySelector('.arms').setAttribute('points', points(shape.arms(frame)));
      group.querySelector('.trail').setAttribute('points', points(trail(way, k)));
      group.querySelector('.tip').setAttribute('cx', dx);
      group.querySelector('.tip').setAttribute('cy', -dy);
    }
    const recorded = replay.ways[0].frames[k];
    const off = (frame) => {
      const [size, unit] = frame && recorded ? shape.apart(frame, recorded) : [null, 'off'];
      return `${digits(size, 3)} ${unit}`;
    };
    const apart = replay.ways.slice(1).map((way) => `${way.name} ${off(way.frames[k])}`);
    const drawnAs = times.value === '1' ? '' : `; the differences are drawn ${times.value} times as large`;
    said.textContent = `${digits(replay.time_s[k], 4)} s: ${apart.join(', ')}${drawnAs}`;
    slider.setAttribute('aria-valuetext', said.textContent);
  };
  rigproof.replayAt = (k) => { slider.value = k; show(k); };

  let playing = false;
  let begun = 0;
  let from = 0;
  const step = (now) => {
    if (!playing) return;
    const time = from + ((now - begun) / 1000) * Number(speed.value);
    let k = Number(slider.value);
    while (k < last && replay.time_s[k + 1] <= time) k++;
    rigproof.replayAt(k);
    if (k >= last) set(false);
    else requestAnimationFrame(step);
  };
  const start = () => { begun = performance.now(); from = replay.time_s[Number(slider.value)]; };
  const set = (on) => {
    playing = on;
    play.textContent = on ? 'Pause' : 'Play';
    if (!on) return;
    if (Number(slider.value) >= last) slider.value = 0;
    start();
    requestAnimationFrame(step);
  };
  play.addEventListener('click', () => set(!playing));
  speed.addEventListener('change', start);
  times.addEventListener('change', () => show(Number(slider.value)));
  slider.max = last;
  slider.addEventListener('input', () => { show(Number(slider.value)); start(); });
  document.getElementById('replay-csv').addEventListener('click', () => {
    const head = ['time (s)', ...replay.ways.flatMap((way) => shape.columns.map(([name, unit]) => `${name}, ${way.name} (${unit})`))];
    const row = (t, k) => [t, ...replay.ways.flatMap((way) => shape.columns.map(([, , place]) => way.frames[k]?.[place] ?? null))];
    rigproof.saveCsv('replay', [head, ...replay.time_s.map(row)]);
  });
  show(0);
})();
