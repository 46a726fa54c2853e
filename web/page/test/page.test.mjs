// The page in a browser: what it lists, draws, checks and follows. OVOID names the tool, PLAYWRIGHT the driver, CHROMIUM
// the browser (/usr/bin/chromium). Without the browser the tests are skipped.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

const browserPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
const skip = existsSync(browserPath) ? false : `${browserPath} is not here`;
const folder = mkdtempSync(join(tmpdir(), 'ovoid-page-'));
let browser;

before(async () => {
  if (skip) return;
  const { chromium } = await import(process.env.PLAYWRIGHT);
  browser = await chromium.launch({ executablePath: browserPath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/** What the tool says, whatever it found; not what it could not do. */
function run(...args) {
  const { status, stdout, stderr } = spawnSync(process.env.OVOID, args, { encoding: 'utf8', cwd: folder, maxBuffer: 1 << 28 });
  assert.ok(status === 0 || status === 1, stderr);
  return stdout;
}

async function open(file) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 750 } }), errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('request', (request) => /^https?:/.test(request.url()) && errors.push(`asks for ${request.url()}`));
  await page.goto(`file://${join(folder, file)}`);
  await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 60000 });
  assert.equal(await page.getAttribute('body', 'data-ready'), 'yes', await page.textContent('#said'));
  return { page, errors };
}

const scene = {
  unit: 'mm',
  objects: [
    { name: 'table', box: [4, 4, 0.2], pose: { xyz: [0, 0, -0.1] } },
    { name: 'crate', box: [1, 1, 1], pose: { xyz: [0, 0, 0.7], rpy: [0, 0, 0.4] } },
    { name: 'ball', sphere: 0.25, pose: { xyz: [1.2, 0, 0.75] } },
    { name: 'rod </script>', capsule: { radius: 0.1, length: 1 }, pose: { xyz: [0.4, 0, 0.5] } },
    { name: 'wedge', points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], pose: { xyz: [0, 1.5, 0.25] } },
  ],
};

const readRows = (page) => page.$$eval('#pairs tr', (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));

test('the list is that of ovoid check, good proofs hold, altered ones do not', { skip }, async () => {
  writeFileSync(join(folder, 'scene.json'), JSON.stringify(scene));
  const lines = run('check', 'scene.json', '--json', '--html', 'scene.html').trim().split('\n').map((line) => JSON.parse(line));
  const { page, errors } = await open('scene.html');
  assert.equal(await page.textContent('#title'), 'scene.json');
  const expected = lines.sort((a, b) => a.lower - b.lower).map(({ a, b, lower }) => [`${a} – ${b}`, lower]), rows = await readRows(page);
  assert.deepEqual(rows.map(([names]) => names), expected.map(([names]) => names));
  rows.forEach(([, text], i) => {
    assert.ok(text.endsWith(' mm'), text);
    assert.ok(Math.abs(parseFloat(text) - expected[i][1]) <= 1e-5 * Math.max(1e-3, Math.abs(expected[i][1])), `${text} ${expected[i][1]}`);
  });
  for (let i = 0; i < rows.length; i++) {
    await page.click(`#pairs tr:nth-child(${i + 1})`);
    await page.keyboard.press('p');
    assert.equal(await page.textContent('#proof'), 'The proof holds.', rows[i][0]);
  }
  await page.fill('#filter', 'ball');
  assert.ok((await readRows(page)).every(([names]) => names.includes('ball')));
  await page.fill('#filter', '');
  await page.fill('#margin', '0');
  assert.equal((await readRows(page)).length, lines.filter((line) => line.lower <= 0).length);
  assert.deepEqual(errors, []);
  await page.close();

  const text = readFileSync(join(folder, 'scene.html'), 'utf8'), [, json] = text.match(/<script id="ovoid-data" type="application\/json">(.*?)<\/script>/s);
  const data = JSON.parse(json);
  for (const pair of data.pairs) {
    pair.answer.lower += 0.01;
    pair.answer.upper += 0.01;
  }
  writeFileSync(join(folder, 'altered.html'), text.replace(json, () => JSON.stringify(data).replaceAll('<', '\\u003c')));
  const altered = await open('altered.html');
  for (let i = 0; i < data.pairs.length; i++) {
    await altered.page.click(`#pairs tr:nth-child(${i + 1})`);
    await altered.page.click('#check');
    assert.match(await altered.page.textContent('#proof'), /bound|status|bracket|point/);
  }
  await altered.page.close();
});

test('a body that is dragged has the brackets that the tool gives for its pose', { skip }, async () => {
  const { page, errors } = await open('scene.html');
  await page.evaluate(() => window.ovoidPage.chooseBody(window.ovoidPage.model.bodies[2]));
  await page.click('#move');
  await page.waitForTimeout(200);
  const [x, y] = await page.evaluate(() => {
    const { view } = window.ovoidPage, at = view.handle.position.clone().project(view.camera), box = view.canvas.getBoundingClientRect();
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 30, y - 20, { steps: 4 });
  await page.mouse.move(x + 60, y - 40, { steps: 4 });
  await page.mouse.up();
  const pose = (await page.textContent('#pose')).split(' ').map(Number);
  assert.ok(Math.hypot(pose[0] - 1.2, pose[1], pose[2] - 0.75) > 0.05, `it did not move: ${pose}`);
  const moved = structuredClone(scene);
  moved.objects[2].pose = { xyz: pose.slice(0, 3), quat_wxyz: pose.slice(3) };
  writeFileSync(join(folder, 'moved.json'), JSON.stringify(moved));
  const wanted = new Map(run('check', 'moved.json', '--json').trim().split('\n').map((line) => JSON.parse(line)).map(({ a, b, lower }) => [`${a} – ${b}`, lower]));
  const live = await page.evaluate(() => window.ovoidPage.model.pairs.map(({ a, b, answer, isLive }) => [`${a.name} – ${b.name}`, answer.lower, isLive]));
  assert.equal(live.filter(([, , isLive]) => isLive).length, 4);
  for (const [names, lower, isLive] of live) if (isLive) assert.ok(Math.abs(lower - wanted.get(names)) < 1e-9, `${names}: ${lower}, the tool ${wanted.get(names)}`);
  await page.click('#reset');
  assert.equal(await page.evaluate(() => window.ovoidPage.model.bodies[2].pose.xyz[0]), 1.2);
  assert.deepEqual(errors, []);
  await page.close();
});

test('layers, keys, themes and exports', { skip }, async () => {
  const { page, errors } = await open('scene.html');
  // How many of the picture's pixels differ from one in the corner.
  const count = () => page.evaluate(() => {
    const { view } = window.ovoidPage;
    view.drawNow();
    const small = document.createElement('canvas');
    small.width = 200;
    small.height = 150;
    const paint = small.getContext('2d');
    paint.drawImage(view.canvas, 0, 0, 200, 150);
    const { data } = paint.getImageData(0, 0, 200, 150);
    let drawn = 0;
    for (let i = 3; i < data.length; i += 4) drawn += data[i] > 0;
    return drawn;
  });
  const all = await count();
  assert.ok(all > 1500, `${all} pixels are drawn`);
  await page.keyboard.press('m');
  assert.ok((await count()) < all / 20, 'without meshes nothing is left');
  await page.keyboard.press('o');
  assert.ok((await count()) > all, 'the outer ellipsoids are larger');
  await page.keyboard.press('m');
  await page.keyboard.press('o');
  await page.click('#pairs tr:nth-child(3)');
  await page.waitForTimeout(600);
  const both = await count();
  await page.keyboard.press('x');
  assert.ok((await count()) < both, 'fewer bodies are left');
  await page.keyboard.press('x');
  const before = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await page.keyboard.press('t');
  assert.notEqual(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), before);
  for (const [button, first] of [['#png', '\x89PNG'], ['#glb', 'glTF']]) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
    assert.equal(readFileSync(await download.path()).toString('latin1', 0, 4), first);
  }
  await page.setViewportSize({ width: 390, height: 800 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390), 'a phone sees all of it');
  assert.deepEqual(errors, []);
  await page.close();
});

test('data that are none are refused with a sentence', { skip }, async () => {
  const text = readFileSync(join(folder, 'scene.html'), 'utf8');
  for (const [json, said] of [['null', /template/], ['{"format": 9}', /format 9/]]) {
    writeFileSync(join(folder, 'bad.html'), text.replace(/(<script id="ovoid-data" type="application\/json">).*?(<\/script>)/s, (_, a, b) => a + json + b));
    const page = await browser.newPage();
    await page.goto(`file://${join(folder, 'bad.html')}`);
    await page.waitForFunction(() => document.body.dataset.ready);
    assert.match(await page.textContent('#said'), said);
    await page.close();
  }
});
