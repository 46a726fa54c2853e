// picture.mjs PAGE.html PICTURE.png: a page as Chromium shows it, 1200 x 750. PLAYWRIGHT names the driver, CHROMIUM the browser.
import { pathToFileURL } from 'node:url';

const { chromium } = await import(process.env.PLAYWRIGHT), [page, picture] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const tab = await browser.newPage({ viewport: { width: 1200, height: 750 }, colorScheme: 'light' });
await tab.goto(pathToFileURL(page).href);
await tab.waitForFunction(() => document.body.dataset.ready, null, { timeout: 60000 });
// The picture at rest, all triangles drawn.
await tab.waitForTimeout(3000);
await tab.screenshot({ path: picture });
await browser.close();
