// Plays the linkage: the recording, and the old and the new model let go from the recorded state again and again.
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
  const trail = (way, k) => {
    const from = Math.max(0, k - 25);
    return way.frames.slice(from, k + 1).map((_, i) => drawn(way, from + i)).filter((f) => f).map((f) => [f[2], f[3]]);
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
      const [ex, ey, dx, dy, cx, cy] = frame;
      group.querySelector('.arms').setAttribute('points', points([replay.a, [ex, ey], [dx, dy], [cx, cy], replay.b]));
      group.querySelector('.trail').setAttribute('points', points(trail(way, k)));
      group.querySelector('.tip').setAttribute('cx', dx);
      group.querySelector('.tip').setAttribute('cy', -dy);
    }
    const recorded = replay.ways[0].frames[k];
    const off = (frame) => (frame && recorded ? 1e3 * Math.hypot(frame[2] - recorded[2], frame[3] - recorded[3]) : null);
    const apart = replay.ways.slice(1).map((way) => `${way.name} ${digits(off(way.frames[k]), 3)} mm off at the tip`);
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
    const head = ['time (s)', ...replay.ways.flatMap((way) => [`tip x, ${way.name} (m)`, `tip y, ${way.name} (m)`])];
    const row = (t, k) => [t, ...replay.ways.flatMap((way) => (way.frames[k] ? [way.frames[k][2], way.frames[k][3]] : [null, null]))];
    rigproof.saveCsv('replay', [head, ...replay.time_s.map(row)]);
  });
  show(0);
})();
