// Drives a page in Debian's Chromium. A script calls pageTest() for each thing it tries; it fails on anything the console
// reports, on an exception, on a request, and where the page scrolls sideways. tests/README.md says how to add one.
import assert from 'node:assert/strict';
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import test, {after} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

/** The folder of the packages and of the pages: a build's tests/page. */
const here = path.dirname(fileURLToPath(import.meta.url));
export const built = process.env.RIGEL_PAGES ?? path.resolve(here, '../../build/release/tests/page');
const {chromium} = createRequire(path.join(built, 'package.json'))('playwright-core');

/** A window, and the theme that the system asks for. */
export const laptop = {name: 'laptop, light', width: 1440, height: 900, theme: 'light'};
export const phone = {name: 'phone, dark', width: 390, height: 844, theme: 'dark'};
export const everyView = [laptop, {...laptop, name: 'laptop, dark', theme: 'dark'}, {...phone, name: 'phone, light', theme: 'light'}, phone];

/** Made-up reports (tests/report/report_fixture.cpp), or the one that the environment names. */
export const reports = process.env.RIGEL_REPORT ? [process.env.RIGEL_REPORT] : ['made-up', 'crowd', 'smallest', 'hostile'];

const kQuiet = ['--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const kDrawing = {false: ['--disable-gpu', '--disable-3d-apis'], true: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader']};
const browsers = {};

/** One browser for all visits of a script; `webgl` draws it on the processor. */
function browser(webgl) {
  browsers[webgl] ??= chromium.launch({executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: [...kQuiet, ...kDrawing[webgl]]});
  return browsers[webgl];
}

export async function closeBrowsers() {
  for (const drawing of Object.keys(browsers)) {
    await (await browsers[drawing]).close();
    delete browsers[drawing];
  }
}
after(closeBrowsers);

/** The file of a page by its name ("made-up", "pareto-gpu"), or a path as it stands. */
export function fileOf(name) {
  const found = [path.join(built, 'pages', name, 'report.html'), path.join(built, 'pages', name, 'pareto.html'), name].find((file) => existsSync(file) && file.endsWith('.html'));
  assert.ok(found, `no page ${name} in ${built}: run ctest -R page_files`);
  return path.resolve(found);
}

/** Opens a page, calls visitor({page, view, data}), and rejects with all that went wrong on the way. */
export async function visit(name, {view = laptop, webgl = false, reducedMotion = 'no-preference', allowSideways = false}, visitor) {
  const context = await (await browser(webgl)).newContext({
    viewport: {width: view.width, height: view.height}, colorScheme: view.theme, reducedMotion, acceptDownloads: true,
  });
  const faults = [];
  try {
    const page = await context.newPage();
    page.setDefaultTimeout(20000);
    const own = pathToFileURL(fileOf(name)).href;
    page.on('console', (message) => faults.push(`console: ${message.text()}`));
    page.on('pageerror', (error) => faults.push(`exception: ${error.message}`));
    page.on('request', (request) => {
      const url = request.url().split('#')[0];
      if (url !== own && !/^(data|blob):/.test(url)) faults.push(`request: ${url}`);
    });
    await page.goto(own);
    await settled(page);
    const data = await page.evaluate(() => JSON.parse(document.querySelector('#report-data, #pareto-data').textContent));
    if (!faults.length) await visitor({page, view, data});
    await settled(page);
    if (!allowSideways) {
      const [needed, given] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
      if (needed > given) faults.push(`the page is wider than its window: ${needed} of ${given} pixels`);
    }
  } catch (error) {
    if (!faults.length) throw error;
    faults.push(error.message);
  } finally {
    await context.close();
  }
  assert.deepEqual(faults, []);
}

/** After this all that waits for a frame or a change of size has been drawn. */
export async function settled(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))));
}

/** Each made-up report in one view or two; a real one in both. */
const kViews = {crowd: [laptop], smallest: [phone], hostile: [phone], 'pareto-cpu': [phone]};

/** A test on a page, once in each view: test(what, page's name, visitor, {views, webgl, reducedMotion}). */
export function pageTest(what, name, visitor, {views = kViews[name] ?? [laptop, phone], ...options} = {}) {
  for (const view of views) test(`${what} (${name}; ${view.name})`, () => visit(name, {view, ...options}, visitor));
}

/**
 * Runs `drive` inside the page, for checks of many elements at once; what it closes over stays outside, `argument` goes in.
 * drive({check, equal, all, press, pointer, button, drawn, data}, argument)
 */
export async function inPage(page, drive, argument) {
  const outcome = await page.evaluate(`(${driven})(${drive}, ${JSON.stringify(argument) ?? 'undefined'})`);
  assert.deepEqual(outcome.failures, []);
  assert.ok(outcome.checks > 0, 'nothing was checked');
}

async function driven(drive, argument) {
  let checks = 0;
  const failures = [];
  const check = (passed, what) => {
    ++checks;
    if (!passed) failures.push(what);
  };
  const all = (node, selector) => [...node.querySelectorAll(selector)];
  await drive({
    check, all, equal: (actual, expected, what) => check(actual === expected, `${what}: ${actual}, not ${expected}`),
    press: (node, key) => node.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true})),
    pointer: (node, type, clientX, clientY = 0) => node.dispatchEvent(new PointerEvent(type, {clientX, clientY, button: 0, bubbles: true})),
    button: (node, group, label) => all(node, `[aria-label="${group}"] button`).find((candidate) => candidate.textContent.trim() === label),
    drawn: () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))),
    data: JSON.parse(document.querySelector('#report-data, #pareto-data').textContent),
  }, argument);
  return {checks, failures};
}
