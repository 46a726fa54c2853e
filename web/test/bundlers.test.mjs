// The package as its users have it: bundled by esbuild, webpack, rollup and vite for browsers, and for Node.js; its types checked by
// TypeScript. BUNDLERS names the folder where web/test/bundlers is installed; without it the tests are skipped. CHROMIUM: the browser.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';

const home = process.env.BUNDLERS, skip = home ? false : 'the bundlers are not installed: scripts/wasm.sh --check does, where npm has its registry';
const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium', GOOD = 'true true null';
const folder = home && mkdtempSync(join(home, 'built-')), entry = home && join(home, 'entry.mjs'), wasm = home && join(home, 'node_modules/ovoid/ovoid.wasm');
after(() => folder && rmSync(folder, { recursive: true }));

const need = async (name) => {
  const found = await import(pathToFileURL(createRequire(join(home, 'x.mjs')).resolve(name)));
  return found.default ?? found;
};

/** A folder for what a bundler writes, where only a module has the wasm file beside it. */
function makeFolder(name, hasWasm) {
  const at = join(folder, name);
  mkdirSync(at);
  if (hasWasm) cpSync(wasm, join(at, 'ovoid.wasm'));
  return at;
}

const builds = {
  async esbuild(at, platform) {
    const { build } = await need('esbuild');
    await build({ entryPoints: [entry], bundle: true, format: 'esm', platform, outfile: join(at, 'out.mjs'), logLevel: 'silent' });
  },
  async webpack(at, platform) {
    const { webpack } = await need('webpack'), isNode = platform === 'node';
    const stats = await new Promise((resolve, reject) => webpack({
      mode: 'production', context: home, entry, target: isNode ? 'node18' : 'web', performance: { hints: false }, experiments: { outputModule: true },
      output: { path: at, filename: 'out.mjs', module: true, library: isNode ? undefined : { type: 'module' } },
    }, (error, result) => (error ? reject(error) : resolve(result))));
    assert.ok(!stats.hasErrors() && !stats.hasWarnings(), stats.toString());
  },
  async rollup(at, platform) {
    const { rollup } = await need('rollup'), { nodeResolve } = await need('@rollup/plugin-node-resolve'), warnings = [];
    const bundle = await rollup({ input: entry, plugins: [nodeResolve({ browser: platform === 'browser', exportConditions: [platform] })], external: /^node:/, onwarn: ({ message }) => warnings.push(message) });
    await bundle.write({ file: join(at, 'out.mjs'), format: 'es' });
    assert.deepEqual(warnings, []);
  },
  async vite(at) {
    const { build } = await need('vite');
    await build({
      root: home, logLevel: 'silent', configFile: false, base: './',
      build: { outDir: at, target: 'es2022', rollupOptions: { input: entry, output: { entryFileNames: 'out.mjs', assetFileNames: '[name][extname]' } } },
    });
  },
};

/** What the page of a bundle says in the browser, served as files are. */
async function runInBrowser(at) {
  const types = { html: 'text/html', mjs: 'text/javascript', js: 'text/javascript', wasm: 'application/wasm' };
  writeFileSync(join(at, 'index.html'), '<!doctype html><title>waiting</title><script type="module" src="out.mjs"></script>');
  const server = createServer(({ url }, response) => {
    const file = join(at, url === '/' ? 'index.html' : new URL(url, 'http://x').pathname);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[file.split('.').pop()] ?? 'text/plain' }).end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const browser = await (await need('playwright-core')).chromium.launch({ executablePath: chromium, args: ['--no-sandbox', '--disable-dev-shm-usage'] });
  try {
    const page = await browser.newPage(), errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.waitForFunction(() => document.title !== 'waiting', null, { timeout: 30000 }).catch(() => assert.fail(errors.join('; ') || 'nothing was said'));
    return await page.title();
  } finally {
    await browser.close();
    server.close();
  }
}

for (const name of Object.keys(builds))
  test(`a bundle of ${name} for browsers`, { skip: skip || (existsSync(chromium) ? false : `${chromium} is not here`) }, async () => {
    const at = makeFolder(`${name}-browser`, name === 'esbuild' || name === 'rollup');
    await builds[name](at, 'browser');
    assert.doesNotMatch(readFileSync(join(at, 'out.mjs'), 'utf8'), /node:fs/);
    assert.equal(await runInBrowser(at), GOOD);
  });

for (const name of ['esbuild', 'webpack', 'rollup'])
  test(`a bundle of ${name} for Node.js`, { skip }, async () => {
    const at = makeFolder(`${name}-node`, name !== 'webpack');
    await builds[name](at, 'node');
    assert.equal(execFileSync(process.execPath, [join(at, 'out.mjs')], { encoding: 'utf8' }).trim(), GOOD);
  });

test('the types: what is right is taken, what is wrong is refused', { skip }, () => {
  const args = ['--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--exactOptionalPropertyTypes', 'types.ts'];
  const { status, stdout } = spawnSync(process.execPath, [join(home, 'node_modules/typescript/bin/tsc'), ...args], { cwd: home, encoding: 'utf8' });
  assert.equal(status, 0, stdout);
});
