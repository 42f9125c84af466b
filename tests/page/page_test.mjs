// The report's page in Debian's Chromium.
//
//   node page_test.mjs MAKE_PAGE LIBRARIES_FOLDER
//
// MAKE_PAGE writes pages of made-up records (make_page.cpp). The libraries are fetched into the
// folder from the lock file here. Without Chromium: exit code 77, or 1 where $CI is set.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { performanceProfiles } from '../../results/report/web/profile.js';
import { CHROMIUM, hasChromium, launch, open } from './browser.mjs';

const [makePage, libraries] = process.argv.slice(2);
const here = path.dirname(fileURLToPath(import.meta.url));

if (!hasChromium()) {
  console.log(`${CHROMIUM} is missing (Debian package chromium): the page is not tested in a browser`);
  process.exit(process.env.CI ? 1 : 77);
}

function fetchLibraries() {
  for (const name of ['package.json', 'package-lock.json']) {
    copyFileSync(path.join(here, name), path.join(libraries, name));
  }
  execFileSync('npm', ['ci', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: libraries, stdio: 'inherit' });
}

const folder = mkdtempSync(path.join(tmpdir(), 'conebench-page-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

function make(name, ...args) {
  const file = path.join(folder, name);
  execFileSync(makePage, [file, ...args]);
  return file;
}

fetchLibraries();
const page20 = make('page.html', '20', '6', '--space');
const browser = await launch(libraries);
after(() => browser.close());

/** Opens, does, and then nothing may have gone wrong. */
async function on(file, options, work) {
  const { page, trouble, close } = await open(browser, file, options);
  try {
    await work(page);
    assert.deepEqual(trouble, []);
  } finally {
    await close();
  }
}

async function drawn(page, id) {
  const figure = page.locator(`#${id}`);
  await figure.scrollIntoViewIfNeeded();
  await figure.locator('.drawing canvas, .drawing svg').first().waitFor();
  return figure;
}

const SECTIONS = ['verdict', 'ranking', 'step', 'profiles', 'tails', 'scaling', 'warm', 'models', 'ends', 'problems'];

test('the verdict comes first, and every section is there in its order', () =>
  on(page20, {}, async (page) => {
    const ids = await page.locator('main section:visible').evaluateAll((nodes) => nodes.map((node) => node.id));
    assert.deepEqual(ids, [...SECTIONS.map((id) => `g0-${id}`), 'views', 'environment', 'limits']);
    assert.match(await page.locator('#g0-verdict .lead').innerText(), /eta ≤\s?1e-08/);
  }));

for (const width of [1280, 390]) {
  for (const dark of [false, true]) {
    test(`every plot is drawn, ${width} px wide, ${dark ? 'dark' : 'light'}, and nothing sticks out`, () =>
      on(page20, { width, dark }, async (page) => {
        const figures = await page.locator('figure.plot:visible').evaluateAll((nodes) => nodes.map((node) => node.id));
        assert.ok(figures.length >= 9, `${figures}`);
        for (const id of figures) {
          const figure = await drawn(page, id);
          assert.ok(await figure.locator('figcaption h3').innerText());
        }
        const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        assert.ok(content <= window, `${content} px in a window of ${window} px`);
        const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        assert.equal(ground, dark ? 'rgb(20, 23, 27)' : 'rgb(255, 255, 255)');
      }));
  }
}

test('pointing at a curve tells every solver there', () =>
  on(page20, {}, async (page) => {
    const figure = await drawn(page, 'g0-plot-ecdf');
    const box = await figure.locator('.u-over').boundingBox();
    await page.mouse.move(box.x + 0.9 * box.width, box.y + 0.3 * box.height);
    const tip = figure.locator('.tip');
    await tip.waitFor();
    assert.match(await tip.innerText(), /solver time: [\d.]+ (us|ms|s)/);
    assert.equal(await tip.locator('div').count(), 6);
    assert.match(await tip.innerText(), /solver-00\[omega=1\.0\]\s+[\d.]+ %/);
    await page.mouse.move(5, 5);
    await tip.waitFor({ state: 'hidden' });
  }));

test('keys read the values of curves and of dots', () =>
  on(page20, {}, async (page) => {
    for (const id of ['g0-plot-profile', 'g0-plot-solved']) {
      const figure = await drawn(page, id);
      await figure.locator('.drawing').focus();
      await page.keyboard.press('ArrowRight');
      await page.keyboard.press('ArrowRight');
      assert.match(await figure.locator('.said').textContent(), /solver-0\d.* %/);
      await page.keyboard.press('Escape');
      await figure.locator('.tip').waitFor({ state: 'hidden' });
    }
  }));

test('a click in a legend hides a solver in all plots', () =>
  on(page20, {}, async (page) => {
    const first = await drawn(page, 'g0-plot-profile');
    const second = await drawn(page, 'g0-plot-tolerance');
    const entry = (figure) => figure.locator('.legend button').first();
    await entry(first).click();
    assert.equal(await entry(second).getAttribute('aria-pressed'), 'false');
    await entry(second).click();
    assert.equal(await entry(first).getAttribute('aria-pressed'), 'true');
  }));

// Of three problems: a is the fastest on two and fails on one, b solves all, c was not run on one.
const TIMES = [[1, 2, null], [2, 8, 3], [4, false, 6]];

test('a performance profile is that of the solvers shown', () => {
  const three = performanceProfiles(TIMES, [true, true, true]);
  assert.deepEqual(three.map(({ x, y }) => [x, y]), [[[1], [0.5]], [[1, 2], [0.5, 1]], [[2, 4], [0.5, 1]]]);
  assert.deepEqual(three.map(({ solved, problems }) => `${solved}/${problems}`), ['1/2', '2/2', '2/2']);
  const [a, b, c] = performanceProfiles(TIMES, [true, true, false]);
  assert.deepEqual([a.x, a.y], [[1], [2 / 3]]);
  assert.deepEqual([b.x, b.y], [[1, 2, 4], [1 / 3, 2 / 3, 1]]);
  assert.deepEqual(c, { x: [], y: [], solved: 0, problems: 3 });
  assert.deepEqual(performanceProfiles(TIMES, [false, true, false])[1], { x: [1], y: [1], solved: 3, problems: 3 });
  assert.deepEqual(performanceProfiles([[1e-9], [2e-9]], [true, true]).map(({ x }) => x), [[1], [1]]);
});

// The rows of a plot's CSV as {solver: [[x, y], ...]}.
async function curvesOf(page, figure) {
  const curves = {};
  for (const line of (await download(page, figure.locator('button', { hasText: 'CSV' }))).trim().split('\r\n').slice(1)) {
    const [name, x, y] = line.split(',');
    (curves[name] ??= []).push([Number(x), Number(y)]);
  }
  return curves;
}

test('hiding a solver makes the performance profile anew for the others', () =>
  on(page20, {}, async (page) => {
    const figure = await drawn(page, 'g0-plot-profile');
    const canvas = () => figure.locator('canvas').evaluate((node) => node.toDataURL());
    const entry = (name) => figure.locator('.legend button', { hasText: name });
    const wins = (curve) => curve.filter(([x]) => x === 1).at(-1)?.[1] ?? 0;
    const [before, pictureBefore] = [await curvesOf(page, figure), await canvas()];
    const [best] = Object.entries(before).sort((a, b) => wins(b[1]) - wins(a[1]))[0];
    assert.ok(wins(before[best]) > 0);
    await entry(best).click();
    const after = await curvesOf(page, figure);
    assert.equal(after[best], undefined);
    const others = Object.keys(before).filter((name) => name !== best);
    const gained = others.filter((name) => wins(after[name]) > wins(before[name]));
    assert.ok(gained.length > 0, 'who was second to the hidden one is the fastest now');
    for (const name of others) {
      assert.ok(wins(after[name]) >= wins(before[name]), name);
      assert.ok(Math.abs(after[name].at(-1)[1] - before[name].at(-1)[1]) < 1e-3, 'what it solves it still solves');
    }
    assert.notEqual(await canvas(), pictureBefore);
    assert.match(await download(page, figure.locator('button', { hasText: 'SVG' })), /problems solved \[% of all\]/);
    await entry(best).click();
    assert.deepEqual(await curvesOf(page, figure), before);
  }));

test('a choice changes what is drawn', () =>
  on(page20, {}, async (page) => {
    const figure = await drawn(page, 'g0-plot-profile');
    const before = await figure.locator('canvas').evaluate((canvas) => canvas.toDataURL());
    await figure.locator('.tabs button', { hasText: '1e-04' }).click();
    const after = await figure.locator('canvas').evaluate((canvas) => canvas.toDataURL());
    assert.notEqual(before, after);
  }));

// Chromium drops what a page saves beyond ten files a second: no person is as quick.
async function download(page, button) {
  await page.waitForTimeout(150);
  const [file] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return readFileSync(await file.path(), 'utf8');
}

test('every plot can be had as SVG and as CSV', () =>
  on(page20, {}, async (page) => {
    for (const figure of await page.locator('figure.plot:visible').all()) {
      const id = await figure.getAttribute('id');
      await drawn(page, id);
      const svg = await download(page, figure.locator('button', { hasText: 'SVG' }));
      assert.match(svg, /^<svg[^>]*xmlns="http:\/\/www.w3.org\/2000\/svg"/, id);
      assert.match(svg, /<style[^>]*>\.panel/, id);
      const lines = (await download(page, figure.locator('button', { hasText: 'CSV' }))).trim().split('\r\n');
      assert.ok(lines.length > 1, `${id}: ${lines[0]}`);
    }
  }));

test('the theme can be chosen', () =>
  on(page20, {}, async (page) => {
    const figure = await drawn(page, 'g0-plot-solved');
    const colour = () => figure.locator('circle').first().evaluate((node) => getComputedStyle(node).color);
    const light = await colour();
    await page.locator('#theme').click();
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(20, 23, 27)');
    assert.notEqual(await colour(), light);
    assert.equal(await page.locator('#theme').innerText(), 'Light');
  }));

test('rules are chosen at the top', () =>
  on(page20, {}, async (page) => {
    assert.ok(await page.locator('#g0-verdict').isVisible());
    await page.locator('#group').selectOption('1');
    assert.ok(!(await page.locator('#g0-verdict').isVisible()));
    await drawn(page, 'g1-plot-warm');
    assert.equal(await page.locator('nav a').first().getAttribute('href'), '#g1-verdict');
  }));

const names = (page) => page.locator('#g0-problems tbody th button').allInnerTexts();
const head = (page, text) => page.locator('#g0-problems thead button', { hasText: text });

test('the table sorts by any column, both ways', () =>
  on(page20, {}, async (page) => {
    const cones = async () =>
      (await page.locator('#g0-problems tbody tr:not(.space) td:nth-child(3)').allInnerTexts()).map(Number);
    await head(page, 'cones').click();
    const rising = await cones();
    assert.deepEqual(rising, [...rising].sort((a, b) => a - b));
    assert.equal(rising.length, 20);
    await head(page, 'cones').click();
    assert.deepEqual(await cones(), rising.toReversed());
    assert.equal(await page.locator('#g0-problems th[aria-sort="descending"]').innerText(), 'cones▼');
  }));

test('the table filters by text, scene, outcome, failure and size', () =>
  on(page20, {}, async (page) => {
    const section = page.locator('#g0-problems');
    const count = () => section.locator('.count').innerText();
    assert.equal(await count(), '20 of 20 problems');
    await section.locator('input[type=search]').fill('_00001');
    assert.equal(await count(), '10 of 20 problems');
    assert.ok((await names(page)).every((name) => name.includes('_00001')));
    await section.locator('input[type=search]').fill('');
    await section.getByLabel('Scene').selectOption('dem/scene-001');
    assert.equal(await count(), '10 of 20 problems');
    await section.getByLabel('Scene').selectOption('');
    await section.getByLabel('Cones from').fill('100');
    const large = Number((await count()).split(' ')[0]);
    assert.ok(large > 0 && large < 20);
    await section.getByLabel('Cones from').fill('');
    const some = [];
    for (const outcome of ['none', 'some', 'every']) {
      await section.getByLabel('Outcome').selectOption(outcome);
      some.push(Number((await count()).split(' ')[0]));
    }
    assert.equal(some[0] + some[1] + some[2], 20);
    assert.ok(some[1] > 0 && some[2] > 0, `${some}`);
    const csv = await download(page, section.locator('form button', { hasText: 'CSV' }));
    assert.equal(csv.trim().split('\r\n').length, 1 + some[2]);
  }));

test('a problem opens with its curves and goes to space', () =>
  on(page20, {}, async (page) => {
    await page.locator('#g0-problems tbody th button', { hasText: '_000003' }).click();
    const details = page.locator('#g0-problems .details');
    assert.match(await details.innerText(), /scene-000_000003/);
    await details.locator('canvas').waitFor();
    assert.equal(await details.locator('tbody tr').count(), 6);
    assert.match(await download(page, details.locator('button', { hasText: 'SVG' })), /Convergence on this problem/);
    await details.locator('button', { hasText: 'Show it in space' }).click();
    assert.match(await page.locator('.views').innerText(), /scene-000_000003: 90 contacts/);
  }));

test('a problem in space turns, zooms, and says what a contact does', () =>
  on(page20, {}, async (page) => {
    const stage = page.locator('.view-stage');
    await stage.scrollIntoViewIfNeeded();
    await stage.locator('canvas').waitFor();
    const camera = () => stage.getAttribute('data-camera');
    const start = await camera();
    const box = await stage.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 120, y + 30, { steps: 5 });
    await page.mouse.up();
    const turned = await camera();
    assert.notEqual(turned, start);
    await stage.focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('+');
    assert.notEqual(await camera(), turned);
    await page.keyboard.press('n');
    assert.match(await page.locator('.views .said').textContent(), /contact \d+: body \d+ on (body \d+|wall).*status(open|stick|slide)/);
  }));

test('contacts are coloured by what is chosen, of either answer or of their difference', () =>
  on(page20, {}, async (page) => {
    const views = page.locator('.views');
    await page.locator('.view-stage').scrollIntoViewIfNeeded();
    const scale = () => views.locator('.scale').innerText();
    assert.match(await scale(), /open: \d+\s+stick: \d+\s+slide: \d+/);
    const seen = new Set();
    const colours = await views.getByLabel('Colour').locator('option').allInnerTexts();
    assert.equal(colours.length, 10);
    for (const colour of colours) {
      await views.getByLabel('Colour').selectOption({ label: colour });
      seen.add(await scale());
    }
    assert.equal(seen.size, colours.length);
    await views.getByLabel('Answer of').selectOption('1');
    await views.getByLabel('force chains').uncheck();
    const lines = (await download(page, views.locator('button', { hasText: 'CSV' }))).trim().split('\r\n');
    assert.equal(lines.length, 1 + 90);
    assert.match(await download(page, views.locator('button', { hasText: 'SVG' })), /<circle/);
  }));

test('the page reads without scripts', () =>
  on(page20, { scripts: false }, async (page) => {
    const svgs = page.locator('#g0 figure svg:visible');
    assert.ok((await svgs.count()) >= 9);
    assert.match(await page.locator('#g0-plot-profile svg').first().textContent(), /problems solved \[% of all\]/);
    assert.equal(await page.locator('#g0-problems tbody tr').count(), 20);
    assert.ok(!(await page.locator('#theme').isVisible()));
    assert.match(await page.locator('#g0-verdict').innerText(), /Limits of this verdict/);
  }));

test('the policy lets no other script or style in', async () => {
  const { page, trouble, close } = await open(browser, page20);
  await page.evaluate(() => {
    const script = document.createElement('script');
    script.textContent = 'globalThis.smuggled = true';
    document.body.append(script);
  });
  assert.equal(await page.evaluate(() => globalThis.smuggled), undefined);
  assert.equal(trouble.length, 1, `${trouble}`);
  assert.match(trouble[0], /Content Security Policy/);
  const policy = await page.locator('meta[http-equiv]').getAttribute('content');
  assert.match(policy, /^default-src 'none'; /);
  assert.doesNotMatch(policy, /unsafe|https?:/);
  await close();
});

test('200 problems and 20 solvers are less than 3 MB', () => {
  const { size } = statSync(make('large.html', '200', '20'));
  console.log(`200 x 20: ${(size / 1e6).toFixed(2)} MB`);
  assert.ok(size < 3e6, `${size} bytes`);
});

test('of 5000 problems the table holds only the rows in sight', () =>
  on(make('huge.html', '5000', '20'), {}, async (page) => {
    await page.waitForFunction(() => performance.getEntriesByName('first-contentful-paint').length > 0);
    const times = await page.evaluate(() => ({
      paint: performance.getEntriesByName('first-contentful-paint')[0].startTime,
      ready: performance.now(),
    }));
    console.log(`5000 x 20: first view after ${times.paint.toFixed(0)} ms, all ready after ${times.ready.toFixed(0)} ms`);
    const section = page.locator('#g0-problems');
    await section.scrollIntoViewIfNeeded();
    assert.equal(await section.locator('.count').innerText(), '5000 of 5000 problems');
    const rows = section.locator('tbody tr:not(.space)');
    assert.ok((await rows.count()) < 80);
    await section.locator('.window').evaluate((node) => { node.scrollTop = node.scrollHeight; });
    await section.locator('tbody th button', { hasText: '_004999' }).waitFor();
    assert.ok((await rows.count()) < 80);
  }));
