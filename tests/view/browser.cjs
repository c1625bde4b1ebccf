// Opens pages in Chromium and prints what it finds as JSON, one line a page.
//
//     node browser.cjs CHROMIUM PAGE.html[=PICTURE.png]...
//
// NODE_PATH names the folder with `puppeteer-core`. Nothing but the pages themselves may be requested.
'use strict';
const { pathToFileURL } = require('node:url');
const { mkdtempSync, rmSync } = require('node:fs');
const { join } = require('node:path');
const { tmpdir } = require('node:os');
const puppeteer = require('puppeteer-core');

const FLAGS = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
  '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** A number that changes with the picture. */
function picture() {
  const { renderer } = globalThis.holonom;
  const gl = renderer.getContext();
  const pixels = new Uint8Array(gl.drawingBufferWidth * gl.drawingBufferHeight * 4);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let sum = 0;
  for (const value of pixels) sum = (sum * 31 + value) >>> 0;
  return sum;
}

/** Goes to a part of the motion, and waits until it is drawn. */
async function seek(page, part) {
  await page.evaluate((at) => {
    const { holonom } = globalThis;
    holonom.seek(holonom.start + at * (holonom.end - holonom.start));
  }, part);
  await settle(page);
}

async function settle(page) {
  await page.evaluate(() => new Promise((done) => {
    const from = globalThis.holonom.frames;
    const wait = () => (globalThis.holonom.frames > from + 2 ? done() : requestAnimationFrame(wait));
    wait();
  }));
}

async function part(page) {
  return page.evaluate(() => (globalThis.holonom.t - globalThis.holonom.start) / (globalThis.holonom.end - globalThis.holonom.start));
}

/** Where a click at a part of the curve goes. */
async function clickCurve(page, at) {
  const curve = await page.$('.u-over');
  if (!curve) return null;
  const box = await curve.boundingBox();
  await page.mouse.click(box.x + at * box.width, box.y + 0.5 * box.height);
  return part(page);
}

/** True if a drag over the picture changes it. */
async function dragTurns(page) {
  const before = await page.evaluate(picture);
  const box = await (await page.$('#view canvas')).boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.6 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.7 * box.height, { steps: 4 });
  await page.mouse.up();
  await settle(page);
  return before !== await page.evaluate(picture);
}

/** Presses a key and tells the part of the motion there. */
async function press(page, key) {
  await page.keyboard.press(key);
  await settle(page);
  return part(page);
}

/** True if nothing that is placed is not a number. */
function isFinite() {
  let finite = true;
  globalThis.holonom.scene.traverse((object) => { finite = finite && object.matrixWorld.elements.every(Number.isFinite); });
  return finite;
}

async function inspect(browser, path, target) {
  const page = await browser.newPage();
  const errors = [];
  const requests = [];
  page.on('console', (message) => ['error', 'warn'].includes(message.type()) && !/GL Driver Message/.test(message.text()) && errors.push(message.text()));
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('dialog', (dialog) => { errors.push(`dialog ${dialog.message()}`); dialog.dismiss(); });
  const address = pathToFileURL(path).href;
  page.on('request', (request) => request.url() !== address && requests.push(request.url()));
  await page.setViewport({ width: 1100, height: 760 });
  const dark = (process.env.DARK || '').split(',').some((name) => name && path.includes(name));
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }]);
  const from = Date.now();
  await page.goto(address);
  await page.waitForFunction('globalThis.holonom && globalThis.holonom.frames > 2', { timeout: 60000 });
  const found = { path, load: Date.now() - from, rows: await page.evaluate('globalThis.holonom.clips[0].t.length') };
  await seek(page, 0);
  const pictures = [];
  for (const at of [0, 0.35, 0.8]) {
    await seek(page, at);
    pictures.push(await page.evaluate(picture));
  }
  found.moves = new Set(pictures).size > 1;
  found.clicked = await clickCurve(page, 0.25);
  found.home = await press(page, 'Home');
  found.step = await press(page, 'ArrowRight');
  found.end = await press(page, 'End');
  await seek(page, Number(process.env.AT || 0.35));
  if (process.env.SCRIPT) await page.evaluate(process.env.SCRIPT);
  await settle(page);
  if (target) await page.screenshot({ path: target });
  found.finite = await page.evaluate(isFinite);
  found.turns = await dragTurns(page);
  found.modes = await modes(page);
  found.title = await page.title();
  found.alerted = await page.evaluate('globalThis.alerted === true');
  await page.close();
  return { ...found, errors, requests };
}

/** For a page with modes: their labels, and whether the first one moves the picture. */
async function modes(page) {
  const labels = await page.evaluate('globalThis.holonom.modes.map((mode) => mode.label)');
  if (!labels.length) return { labels, swings: false };
  await page.select('#mode-kind', 'modes');
  await settle(page);
  const before = await page.evaluate(picture);
  await settle(page);
  const swings = before !== await page.evaluate(picture);
  return { labels, swings };
}

async function main([executablePath, ...pages]) {
  const userDataDir = mkdtempSync(join(tmpdir(), 'chromium-'));
  const browser = await puppeteer.launch({ executablePath, userDataDir, args: FLAGS });
  try {
    for (const one of pages) {
      const [path, target] = one.split('=');
      console.log(JSON.stringify(await inspect(browser, path, target)));
    }
  } finally {
    await browser.close();
    rmSync(userDataDir, { recursive: true, force: true });
  }
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error);
  process.exit(1);
});
