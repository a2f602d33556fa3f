// Opens pages in Firefox: `node smoke.mjs FIREFOX PAGE…`. What Chromium's check tries in detail is tried here once: a second engine runs the scripts, draws the
// charts and turns dark. Ends with 1 and a line for each thing that does not hold.
import { basename, dirname, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

const [executablePath, ...pages] = process.argv.slice(2);
const failures = [];
let checks = 0;

async function smoke(browser, file) {
  const name = `${basename(dirname(resolve(file)))}-${basename(file, '.html')}`;
  const holds = (what, condition) => {
    checks += 1;
    if (!condition) failures.push(`${name}: ${what}`);
  };
  const page = await browser.newPage();
  page.on('pageerror', (error) => holds(`error: ${error.message}`, false));
  await page.setViewport({ width: 1280, height: 900 });
  await page.goto(pathToFileURL(resolve(file)).href, { waitUntil: 'load' });
  const settled = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.evaluate(() => document.querySelectorAll('details').forEach((own) => { own.open = true; }));
  await settled();
  await settled();
  holds('a headline', (await page.$eval('h1', (own) => own.textContent.trim().length)) > 20);
  const [places, inks] = await page.evaluate(() => [document.querySelectorAll('.plot').length, Object.values(rigproof.charts).map(({ plot, spec }) => {
    const { canvas } = plot.ctx;
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return [spec.id, data.reduce((count, own, k) => count + (k % 4 === 3 && own > 200 ? 1 : 0), 0)];
  })]);
  holds(`${inks.length} charts in ${places} places`, inks.length === places);
  for (const [id, ink] of inks) holds(`chart ${id} has ${ink} pixels`, ink > 500);
  const back = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const before = await back();
  await page.$eval('#theme', (own) => own.click());
  holds('dark differs from light', before !== (await back()));
  const said = () => page.$eval('#what-if-time-line', (own) => own.textContent);
  if (await page.$('[data-what-if]')) {
    const whole = await said();
    await page.$eval('[data-what-if]', (own) => own.click());
    holds('a switch says what is left over', whole !== (await said()));
  }
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  holds(`the page is ${wide} px wide`, wide <= 1280);
  await page.close();
}

const browser = await puppeteer.launch({ browser: 'firefox', executablePath, headless: true, timeout: 180000, protocolTimeout: 600000 });
try {
  for (const file of pages) await smoke(browser, file);
} finally {
  await browser.close();
}
for (const failure of failures) console.error(failure);
console.log(`${checks} checks on ${pages.length} pages in a second engine, ${failures.length} do not hold`);
process.exit(failures.length === 0 ? 0 : 1);
