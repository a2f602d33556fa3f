// Opens pages in a real browser and uses them as a person does: `node check.mjs CHROMIUM PAGE…`, a page being a file, or an address of `rigproof serve`. Ends with 1 and a
// line for each thing that does not hold. RIGPROOF_DROP names a recording, and where it is laid while a list of runs is looked at.
import { access, copyFile, mkdtemp, readFile, readdir, rm } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

const [executablePath, ...pages] = process.argv.slice(2);
const axeSource = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const shots = process.env.RIGPROOF_SCREENSHOTS;
const failures = [];
let checks = 0;
const holds = (page, what, condition) => {
  checks += 1;
  if (!condition) failures.push(`${page}: ${what}`);
};

const isServed = (page) => page.startsWith('http://');
const named = (page) => {
  if (!isServed(page)) return `${basename(dirname(resolve(page)))}-${basename(page, '.html')}`;
  const { pathname, search } = new URL(page);
  return `served${decodeURIComponent(pathname + search).replace(/\W+/g, '-')}`;
};

async function check(file) {
  const name = named(file);
  const page = await browser.newPage();
  const requests = [];
  page.on('console', (message) => holds(name, `console: ${message.text()}`, message.type() !== 'error' && (message.type() !== 'warn' || /willReadFrequently/.test(message.text()))));
  page.on('pageerror', (error) => holds(name, `error: ${error.message}`, false));
  page.on('request', (request) => requests.push(request.url()));
  if (!isServed(file)) await page.setOfflineMode(true);
  await page.setViewport({ width: 1280, height: 900 });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'light' }]);
  const url = isServed(file) ? file : pathToFileURL(resolve(file)).href;
  await page.goto(url, { waitUntil: 'load' });
  await settled(page);
  holds(name, 'a headline', (await page.$eval('h1', (h1) => h1.textContent.trim().length)) > 20);
  holds(name, 'a script of a file ran', (await page.evaluate(() => window.hacked)) === undefined);
  await picture(page, `${name}-light`);
  await order(page, name);
  await charts(page, name);
  await replay(page, name);
  await whatIf(page, name);
  await saves(page, name);
  await keyboard(page, name);
  await accessible(page, `${name}, light`);
  await dark(page, name);
  await accessible(page, `${name}, dark`);
  await phone(page, name);
  await paper(page, name);
  const away = requests.filter((request) => request !== url && !/^(data|blob):/.test(request) && !(isServed(file) && request === new URL('/state.json', url).href));
  holds(name, `requests leave the page: ${away.join(' ')}`, away.length === 0);
  await page.close();
}

// A diagnosis begins with its proof; where model and recording agree no place is said to go wrong.
async function order(page, name) {
  const [badge, ids] = await page.evaluate(() => [document.querySelector('.badge')?.textContent, [...document.querySelectorAll('main > section')].map((own) => own.id)]);
  const proof = await page.$('#figure-output');
  if (proof) {
    const { y } = await proof.boundingBox();
    holds(name, `the first section is ${ids[0]}`, ids[0] === 'before-and-after');
    holds(name, `the held-out comparison begins at ${y} px`, y < 1000);
  }
  const clipped = await page.evaluate(() => [...document.querySelectorAll('.scroll:has(td.words)')].filter((own) => own.scrollWidth > own.clientWidth + 1).map((own) => own.closest('section').id));
  holds(name, `sentences are clipped in ${clipped.join(', ')}`, clipped.length === 0);
  const apart = await page.$$eval('#heat-map tr.group', (all) => all.map((own) => own.textContent));
  const turning = await page.$$eval('#heat-map tbody th[scope="row"]', (all) => all.map((own) => own.textContent).filter((own) => /of a reversal$/.test(own)));
  holds(name, `reversals do not stand apart: ${apart}`, turning.length === 0 || apart.length === 2);
  const dead = isServed(page.url()) ? [] : await page.$$eval('main a[href]', (all) => all.map((own) => own.href));
  for (const link of dead) {
    const there = link.startsWith('file:') && await access(new URL(link.split('#')[0])).then(() => true, () => false);
    holds(name, `${link} leads nowhere`, there);
  }
  if (badge === 'Model and rig agree') holds(name, 'agreement goes wrong nowhere', !ids.includes('where'));
}

// A list of runs while a recording comes: it shows its diagnosis without being loaded anew, and what somebody chose stays chosen.
async function fresh(url, from, to) {
  const name = 'served list';
  const page = await browser.newPage();
  page.on('pageerror', (error) => holds(name, `error: ${error.message}`, false));
  await page.goto(url, { waitUntil: 'load' });
  let loads = 0;
  page.on('framenavigated', () => { loads += 1; });
  const options = await page.$$eval('#one option', (all) => all.map((own) => own.value));
  const wanted = [options[2], options[2]];
  for (const [k, id] of ['#one', '#other'].entries()) await page.select(id, wanted[k]);
  await page.focus('#other');
  await copyFile(from, to);
  const run = `${basename(to, '.csv')}-diagnosis`;
  const listed = (run) => [...document.querySelectorAll('#runs tbody th a')].some((own) => own.textContent === run);
  const came = await page.waitForFunction(listed, { timeout: 120000, polling: 200 }, run).then(() => true, () => false);
  holds(name, 'a recording that came is listed', came);
  holds(name, `the list was loaded ${loads} times anew`, loads === 0);
  const [chosen, focus, news, choices] = await page.evaluate(() => [
    [...document.querySelectorAll('select')].map((own) => own.value), document.activeElement.id,
    document.getElementById('news').textContent, [...document.querySelectorAll('#one option')].map((own) => own.value)]);
  holds(name, `chosen: ${chosen} in place of ${wanted}`, String(chosen) === String(wanted));
  holds(name, `the focus went to ${focus}`, focus === 'other');
  holds(name, `news: ${news}`, news.includes(run));
  holds(name, 'the new run can be chosen', choices.includes(run));
  await page.select('#one', run);
  await page.focus('form button');
  await Promise.all([page.waitForNavigation({ waitUntil: 'load' }), page.keyboard.press('Enter')]);
  const title = await page.$eval('h1', (own) => own.textContent);
  holds(name, `compared: ${title}`, title.includes(run) && title.includes(wanted[1]));
  await Promise.all([page.waitForNavigation({ waitUntil: 'load' }), page.click('.verdict p:last-child a:nth-of-type(2)')]);
  // What is folded is drawn when it is opened: places are counted, and one chart at least is drawn.
  const [places, drawn] = [(await page.$$('.plot')).length, (await page.$$('.plot canvas')).length];
  holds(name, `from the comparison to the run: ${places} places, ${drawn} charts at ${page.url()}`, places > 2 && drawn > 0);
  await page.close();
}

// Two frames: what was asked for is drawn.
async function settled(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

async function picture(page, name, fullPage = true) {
  if (shots) await page.screenshot({ path: join(shots, `${name}.png`), fullPage });
}

// Pixels of a chart in the colours of its curves.
const inked = (id) => {
  const { plot, spec } = rigproof.charts[id];
  const { canvas } = plot.ctx;
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const colours = [...new Set(spec.series.map((own) => own.role))].map((role) => rigproof.colour(role).match(/[0-9a-f]{2}/gi).map((own) => parseInt(own, 16)));
  let count = 0;
  for (let k = 0; k < data.length; k += 4) {
    count += data[k + 3] > 200 && colours.some((own) => own.every((part, j) => Math.abs(part - data[k + j]) < 30)) ? 1 : 0;
  }
  return count;
};
const scale = (id) => {
  const { min, max } = rigproof.charts[id].plot.scales.x;
  return [min, max];
};
// Where in a chart, in pixels from its left, the middle of the longest shown stretch lies in which something counts.
const counted = (id) => {
  const { plot } = rigproof.charts[id];
  const [times, ...curves] = plot.data;
  const { min, max } = plot.scales.x;
  const shown = (k) => times[k] >= min && times[k] <= max && curves.some((own) => Number.isFinite(own[k]));
  let [best, begun] = [[0, 0], 0];
  for (let k = 0; k < times.length; k += 1) {
    if (!shown(k)) begun = k + 1;
    else if (k - begun > best[1] - best[0]) best = [begun, k];
  }
  return plot.valToPos(times[Math.round((best[0] + best[1]) / 2)], 'x');
};

async function charts(page, name) {
  // What is folded up is drawn when it is opened.
  await page.evaluate(() => document.querySelectorAll('details').forEach((own) => { own.open = true; }));
  await settled(page);
  await settled(page);
  const parts = await page.evaluate(() => Object.values(rigproof.charts).map(({ plot, spec }) => [spec.id, plot.scales.x.min, plot.scales.x.max, spec.t[0], spec.t[spec.t.length - 1]]).filter(([, min, max, from, to]) => min > from || max < to));
  holds(name, `charts that are not whole on load: ${parts.join('; ')}`, parts.length === 0);
  const ids = await page.evaluate(() => Object.keys(rigproof.charts));
  const places = await page.$$eval('.plot', (plots) => plots.length);
  holds(name, 'every chart has its place', ids.length === places);
  for (const id of ids) {
    const full = await page.evaluate(inked, id);
    await page.evaluate((id) => { const { plot } = rigproof.charts[id]; plot.batch(() => plot.series.forEach((own, k) => k && plot.setSeries(k, { show: false }))); }, id);
    await settled(page);
    const blank = await page.evaluate(inked, id);
    await page.evaluate((id) => { const { plot } = rigproof.charts[id]; plot.batch(() => plot.series.forEach((own, k) => k && plot.setSeries(k, { show: true }))); }, id);
    await settled(page);
    holds(name, `chart ${id} is empty: ${full} pixels, ${blank} without its curves`, full > blank + 150);
  }
  const linked = await page.evaluate(() => Object.values(rigproof.charts).filter((own, k, all) => own.spec.sync && own.spec.sync === all.find((one) => one.spec.sync).spec.sync).map((own) => own.spec.id));
  if (linked.length === 0) return;
  const [first] = linked;
  const whole = await page.evaluate(scale, first);
  const over = await page.$(`#plot-${first} .u-over`);
  await over.scrollIntoView();
  const box = await over.boundingBox();
  const [left, right, middle] = [box.x + 0.3 * box.width, box.x + 0.6 * box.width, box.y + box.height / 2];
  await page.mouse.move(left, middle);
  await page.mouse.down();
  await page.mouse.move((left + right) / 2, middle, { steps: 4 });
  await page.mouse.move(right, middle, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  const zoomed = await page.evaluate(scale, first);
  const share = (zoomed[1] - zoomed[0]) / (whole[1] - whole[0]);
  holds(name, `dragging zooms: ${share}`, share > 0.2 && share < 0.4);
  for (const id of linked) holds(name, `${id} is zoomed with ${first}`, String(await page.evaluate(scale, id)) === String(zoomed));
  await page.mouse.move(box.x + (await page.evaluate(counted, first)), middle);
  await settled(page);
  const values = await page.$$eval(`#plot-${first} .u-value`, (cells) => cells.map((cell) => cell.textContent));
  holds(name, `values under the cursor: ${values}`, values.length > 1 && /\d.* s$/.test(values[0]) && values.slice(1).some((value) => /\d/.test(value)));
  await page.focus(`#plot-${first}`);
  await page.keyboard.press('0');
  await settled(page);
  holds(name, 'the key 0 shows the whole', String(await page.evaluate(scale, first)) === String(whole));
  await page.keyboard.press('+');
  await settled(page);
  const keyed = await page.evaluate(scale, first);
  holds(name, 'the key + zooms in', Math.abs((keyed[1] - keyed[0]) / (whole[1] - whole[0]) - 0.5) < 1e-6);
  await page.click(`[data-chart="${first}"][data-do="whole"]`);
  await settled(page);
}

async function replay(page, name) {
  if (!(await page.$('#replay-time'))) return;
  const arms = () => page.$$eval('#replay-drawing .arms', (all) => all.map((own) => own.getAttribute('points')).join('|'));
  const before = await arms();
  await page.focus('#replay-time');
  for (let k = 0; k < 12; k++) await page.keyboard.press('ArrowRight');
  const after = await arms();
  const seen = await page.$$eval('#replay-drawing .arms', (all) => all.map((own) => own.getBoundingClientRect()).every((box) => Math.max(box.width, box.height) > 30));
  const shape = await page.evaluate(() => rigproof.data.replay.shape);
  holds(name, `what moves (${shape}) is drawn`, seen);
  holds(name, 'the slider moves it', before.split('|').every((points) => points.split(' ').length > 1) && before !== after);
  holds(name, 'the replay says how far apart', /\d (mm|rad) off/.test(await page.$eval('#replay-said', (own) => own.textContent)));
  // Twenty times the difference of the tips, and the recording where it was.
  const tips = () => page.$$eval('#replay-drawing .tip', (all) => all.map((own) => [own.getAttribute('cx'), own.getAttribute('cy')].map(Number)));
  // A joint that turns is off by an angle.
  const turn = ([x, y]) => Math.atan2(y, x);
  const between = shape === 'turning' ? (one, other) => Math.abs(turn(one) - turn(other)) : (one, other) => Math.hypot(one[0] - other[0], one[1] - other[1]);
  const apart = ([recorded, old]) => between(old, recorded);
  const plain = await tips();
  await page.select('#replay-times', '20');
  const [enlarged, words] = [await tips(), await page.$eval('#replay-said', (own) => own.textContent)];
  await page.select('#replay-times', '1');
  // A whole turn looks like none.
  const seenAs = shape === 'turning' ? Math.cos : (size) => size;
  const error = Math.abs(seenAs(apart(enlarged)) - seenAs(20 * apart(plain)));
  holds(name, `differences of ${apart(plain)} are drawn as ${apart(enlarged)}`, error < 1e-5 && String(plain[0]) === String(enlarged[0]));
  holds(name, `the replay says how it is drawn: ${words}`, /20 times/.test(words));
  const at = () => page.$eval('#replay-time', (slider) => Number(slider.value));
  const from = await at();
  const pressed = async () => { await page.focus('#replay-play'); await page.keyboard.press('Enter'); };
  await pressed();
  // A busy machine draws late.
  await page.waitForFunction((from) => Number(document.getElementById('replay-time').value) > from, { timeout: 20000, polling: 100 }, from).catch(() => {});
  await pressed();
  const to = await at();
  await new Promise((done) => setTimeout(done, 200));
  holds(name, `the replay plays and pauses: ${from} to ${to}`, to > from && (await at()) === to);
}

// A named effect that is switched off is missing: more is left over, and the chart shows it; switched on again everything is as before.
async function whatIf(page, name) {
  const boxes = await page.$$('[data-what-if]');
  if (boxes.length === 0) return;
  const said = () => page.$eval('#what-if-time-line', (own) => own.textContent);
  const curve = () => page.evaluate(() => String(rigproof.charts['time-line'].plot.data[2]));
  const [before, drawn] = [await said(), await curve()];
  const left = (text) => Number(text.match(/leaves ([\d.]+)/)?.[1]);
  for (const box of boxes) {
    await box.focus();
    await page.keyboard.press('Space');
    await settled(page);
    const without = await said();
    holds(name, `without an effect: ${without}; with it: ${before}`, left(without) > left(before) && (await curve()) !== drawn);
    await page.keyboard.press('Space');
    await settled(page);
    holds(name, 'an effect that is switched on again is there', (await said()) === before && (await curve()) === drawn);
  }
}

// Every button that saves, saves a file of the kind that it says. The first file is really saved; of the others, what would be: a browser stops at
// a few downloads of one page.
async function saves(page, name) {
  const session = await page.createCDPSession();
  await session.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: saved });
  await page.evaluate(() => document.querySelectorAll('details').forEach((own) => { own.open = true; }));
  const buttons = await page.$$('[data-do="svg"], [data-do="csv"], [data-save-drawing], [data-save-picture], [data-save-table], #replay-csv');
  const figures = await page.$$eval('figure', (all) => all.filter((own) => !own.querySelector('.tools button')).length);
  holds(name, `${figures} figures cannot be saved`, figures === 0);
  for (const [place, button] of buttons.entries()) {
    const label = await button.evaluate((own) => own.getAttribute('aria-label') ?? own.textContent);
    if (place === 1) await page.evaluate(keepWhatIsSaved);
    await button.focus();
    await page.keyboard.press('Enter');
    const text = await waited(place === 0 ? fileSaved : () => page.evaluate(lastKept));
    const fine = /SVG/.test(label) ? await page.evaluate(wellFormed, text) : text.split('\n').length > 2 && /\d/.test(text);
    const instead = text === '' ? `nothing; the folder holds ${await readdir(saved)}` : text.slice(0, 60);
    holds(name, `${label}: ${instead}`, fine);
  }
  await session.detach();
}
const fileSaved = async () => {
  const [file] = (await readdir(saved)).filter((entry) => /\.(svg|csv)$/.test(entry));
  if (!file) return '';
  const text = await readFile(join(saved, file), 'utf8');
  await rm(join(saved, file));
  return text;
};
const keepWhatIsSaved = () => {
  window.kept = [];
  const make = URL.createObjectURL.bind(URL);
  URL.createObjectURL = (blob) => { window.kept.push(blob); return make(blob); };
  HTMLAnchorElement.prototype.click = () => {};
};
const lastKept = async () => (await window.kept.pop()?.text()) ?? '';
// A minute at most: a download on a busy disk may take longer than what the page shows.
async function waited(looked) {
  for (let wait = 0; wait < 1200; wait++) {
    const text = await looked();
    if (text !== '') return text;
    await new Promise((done) => setTimeout(done, 50));
  }
  return '';
}
const wellFormed = (text) => {
  const parsed = new DOMParser().parseFromString(text, 'image/svg+xml');
  return !parsed.querySelector('parsererror') && parsed.querySelectorAll('path, polyline, circle').length > 2 && !text.includes('var(--');
};

async function keyboard(page, name) {
  const wanted = await page.evaluate(() => {
    const visible = (own) => own.offsetParent !== null && !own.disabled && !own.closest('details:not([open]) > :not(summary)');
    const all = [...document.querySelectorAll('a[href], button, input, select, summary, .plot[tabindex]')].filter(visible);
    all.forEach((own, k) => { own.dataset.reach = k; });
    return all.length;
  });
  await page.evaluate(() => { document.activeElement?.blur(); scrollTo(0, 0); });
  const reached = new Set();
  let unseen = 0;
  for (let k = 0; k < wanted + 40; k++) {
    await page.keyboard.press('Tab');
    const [place, outline] = await page.evaluate(() => [document.activeElement?.dataset?.reach, getComputedStyle(document.activeElement).outlineStyle]);
    if (place === undefined || place === null) continue;
    reached.add(place);
    unseen += outline === 'none' ? 1 : 0;
  }
  holds(name, `the keyboard reaches ${reached.size} of ${wanted} controls`, reached.size === wanted);
  holds(name, `${unseen} controls do not show that they have the focus`, unseen === 0);
}

async function accessible(page, name) {
  await page.evaluate(axeSource);
  const violations = await page.evaluate(async () => {
    const result = await axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'best-practice'] });
    return result.violations.map((own) => `${own.id}: ${own.nodes.slice(0, 3).map((node) => node.target.join(' ')).join(', ')}`);
  });
  for (const violation of violations) holds(name, `accessibility: ${violation}`, false);
  checks += 1;
}

async function dark(page, name) {
  const look = () => page.evaluate(() => [getComputedStyle(document.body).backgroundColor, ...Object.values(rigproof.charts).map((own) => own.plot.ctx.canvas.toDataURL().length)].join());
  const light = await look();
  await page.click('#theme');
  await settled(page);
  holds(name, 'dark differs from light', light !== (await look()));
  await picture(page, `${name}-dark`);
  await page.click('#theme');
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'dark' }]);
  await page.reload({ waitUntil: 'load' });
  await settled(page);
  holds(name, 'the system\'s dark is taken over', (await page.evaluate(() => document.documentElement.dataset.theme)) === 'dark');
}

async function phone(page, name) {
  await page.setViewport({ width: 375, height: 800, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'light' }]);
  await page.reload({ waitUntil: 'load' });
  await settled(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  holds(name, `a phone scrolls sideways: ${wide} px of 375`, wide <= 375);
  await short(page, name);
  await picture(page, `${name}-phone`);
}

// A diagnosis of one or two names is read on a phone without scrolling far: what nobody acts on is folded, and what everybody does is open.
async function short(page, name) {
  const names = (await page.$$('#what .effect')).length;
  if (!(await page.$('#before-and-after')) || !(await page.$('#sure')) || names > 2) return;
  await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
  await settled(page);
  const long = await page.evaluate(() => document.documentElement.scrollHeight);
  holds(name, `a diagnosis of ${names} names is ${long} px long at 390 px`, long <= 3434);
  const isOpen = (id) => page.$eval(id, (own) => own.checkVisibility());
  for (const id of ['h1', '#figure-output', '#next > p', ...(names > 0 ? ['#what .effect table'] : [])]) holds(name, `${id} is folded up`, await isOpen(id));
}

async function paper(page, name) {
  await page.setViewport({ width: 1280, height: 900 });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'dark' }]);
  await page.reload({ waitUntil: 'load' });
  await settled(page);
  const pdf = await page.pdf({ format: 'A4', margin: { top: '12mm', bottom: '12mm', left: '12mm', right: '12mm' }, ...(shots ? { path: join(shots, `${name}.pdf`) } : {}) });
  holds(name, `a print of ${pdf.length} bytes`, pdf.length > 20000);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await page.emulateMediaType('print');
  await settled(page);
  const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  holds(name, `paper is ${back}`, back === 'rgb(255, 255, 255)');
  const ink = await page.evaluate(() => getComputedStyle(document.querySelector('h1')).color.match(/\d+/g).reduce((sum, own) => sum + Number(own), 0));
  holds(name, `ink on paper is dark: ${ink}`, ink < 200);
  await page.emulateMediaType(null);
}

const browser = await puppeteer.launch({ executablePath, headless: true, args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage'] });
const saved = await mkdtemp(join(tmpdir(), 'rigproof-saved-'));
try {
  for (const file of pages) await check(file);
  const drop = process.env.RIGPROOF_DROP?.split('\n');
  if (drop) await fresh(pages.find(isServed), ...drop);
} finally {
  await browser.close();
  await rm(saved, { recursive: true, force: true });
}
for (const failure of failures) console.error(failure);
console.log(`${checks} checks on ${pages.length} pages, ${failures.length} do not hold`);
process.exit(failures.length === 0 ? 0 : 1);
