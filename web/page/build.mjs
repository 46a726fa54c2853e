// build.mjs OVOID.wasm PAGE.html: bundles the page's template: one file, nothing to load.
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [wasm, output] = process.argv.slice(2), here = new URL('.', import.meta.url);
const read = (name) => readFileSync(new URL(name, here), 'utf8');
const script = await build({
  entryPoints: [new URL('src/main.mjs', here).pathname], bundle: true, minify: true, format: 'iife', target: 'es2022', write: false, legalComments: 'inline',
  // The module's bytes are in the page; no address is needed.
  define: { 'import.meta.url': '"about:blank"' }, logLevel: 'warning',
});
const licence = `/* three.js: ${readFileSync(new URL('node_modules/three/LICENSE', here), 'utf8').replaceAll('*/', '')} */\n`;
const parts = {
  '/*style*/': read('style.css').replace(/\s+/g, ' '),
  '/*module*/': gzipSync(readFileSync(wasm), { level: 9 }).toString('base64'),
  '/*script*/': licence + script.outputFiles[0].text.replaceAll('</script', '<\\/script'),
};
let page = read('page.html');
for (const [mark, text] of Object.entries(parts)) page = page.split(mark).join(text);
if (page.split('<!--ovoid-data-->').length !== 2) throw new Error('the place of the data must stand in the page once');
writeFileSync(output, page);
console.log(`${output}: ${page.length} bytes`);
