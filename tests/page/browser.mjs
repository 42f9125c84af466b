// Debian's Chromium through playwright-core, with an eye on what a page must not do.
import { accessSync, constants } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

export const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';

export function hasChromium() {
  try {
    accessSync(CHROMIUM, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

/** `libraries`: the folder where `npm ci` has put node_modules. */
export async function launch(libraries) {
  const { chromium } = createRequire(path.resolve(libraries, 'package.json'))('playwright-core');
  // WebGL without a graphics card; no sandbox, since tests may run as root in a container.
  const args = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
  return chromium.launch({ executablePath: CHROMIUM, args });
}

/**
 * Opens a file and watches it: `trouble` collects console errors, warnings and exceptions, and
 * every request for anything but the file itself.
 */
export async function open(browser, file, { width = 1280, height = 900, dark = false, scripts = true } = {}) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: dark ? 'dark' : 'light',
    javaScriptEnabled: scripts,
    acceptDownloads: true,
  });
  const page = await context.newPage();
  const url = pathToFileURL(path.resolve(file)).href;
  const trouble = [];
  // A graphics driver's remarks on speed are not the page's.
  const isOurs = (text) => !/GPU stall|GL Driver Message|swiftshader/i.test(text);
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && isOurs(message.text())) trouble.push(message.text());
  });
  page.on('pageerror', (error) => trouble.push(String(error)));
  page.on('request', (request) => {
    const target = request.url();
    if (target.split('#')[0] !== url && !/^(data|blob):/.test(target)) trouble.push(`request: ${target}`);
  });
  await page.goto(url);
  if (scripts) await page.waitForFunction(() => globalThis.conebench?.data.then(() => true));
  return { page, trouble, close: () => context.close() };
}
