// What the tests of the page share: the tool, the browsers, pages opened in them. OVOID names the tool, PLAYWRIGHT the driver, CHROMIUM
// the browser (/usr/bin/chromium), FIREFOX the other one (/usr/bin/firefox-esr). Without a browser its tests are skipped.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';

const browserPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
export const folder = mkdtempSync(join(tmpdir(), 'ovoid-page-'));
export let browser, flat, skip = existsSync(browserPath) ? false : `${browserPath} is not here`;
if (!skip) {
  const { chromium } = await import(process.env.PLAYWRIGHT);
  const launch = (...args) => chromium.launch({ executablePath: browserPath, args: ['--no-sandbox', '--disable-dev-shm-usage', ...args] });
  try {
    browser = await launch('--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader');
    flat = await launch('--disable-gpu', '--disable-3d-apis');
  } catch (error) {
    skip = `${browserPath} does not start here: ${error.message.split('\n')[0]}`;
  }
}
/** Firefox as it is installed, by WebDriver BiDi: a browser, or a sentence that says why there is none. */
export async function startFirefox() {
  const path = process.env.FIREFOX ?? '/usr/bin/firefox-esr';
  if (!existsSync(path)) return `${path} is not here: scripts/setup.sh page installs it`;
  const { firefox } = await import(process.env.PLAYWRIGHT);
  try {
    return await firefox.launch({ executablePath: path, channel: 'moz-firefox' });
  } catch (error) {
    return `${path} does not start here: ${error.message.split('\n')[0]}`;
  }
}
after(async () => {
  await browser?.close();
  await flat?.close();
  rmSync(folder, { recursive: true });
});

/** What the tool says, whatever it found, decided or not; not what it could not do. */
export function run(...args) {
  const { status, stdout, stderr } = spawnSync(process.env.OVOID, args, { encoding: 'utf8', cwd: folder, maxBuffer: 1 << 28 });
  assert.ok([0, 1, 4].includes(status), stderr);
  return stdout;
}

/** A page without errors or requests. In the browser without WebGL it takes a fraction of the time: for all but pictures. */
export async function open(file, where = browser) {
  const page = await where.newPage({ viewport: { width: 1100, height: 750 } }), errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('request', (request) => /^https?:/.test(request.url()) && errors.push(`asks for ${request.url()}`));
  await page.goto(`file://${join(folder, file)}`);
  await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 60000 });
  assert.equal(await page.getAttribute('body', 'data-ready'), 'yes', await page.textContent('#said'));
  return { page, errors };
}

/** Until the camera is where it flies to, however busy the machine is. */
export const land = (page) => page.waitForFunction(() => !window.ovoidPage.view.flight && !window.ovoidPage.view.isDue);

/** A page with its data altered. */
export function alter(file, change) {
  const text = readFileSync(join(folder, file), 'utf8'), [, json] = text.match(/<script id="ovoid-data" type="application\/json">(.*?)<\/script>/s);
  const data = JSON.parse(json);
  change(data);
  writeFileSync(join(folder, 'altered.html'), text.replace(json, () => JSON.stringify(data).replaceAll('<', '\\u003c')));
}

/** The files of examples/start, and the arguments of its arm. */
export const inStart = (name) => join(new URL('../../../examples/start/', import.meta.url).pathname, name);
export const startArm = [inStart('arm.urdf'), '--srdf', inStart('arm.srdf'), '--scene', inStart('cell.json')];
