// Pictures of every section of a report's page, wide and narrow, light and dark.
//
//   node screenshots.mjs PAGE.html OUT_FOLDER LIBRARIES_FOLDER
import { mkdirSync } from 'node:fs';
import path from 'node:path';
import { launch, open } from './browser.mjs';

const [file, folder, libraries] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const browser = await launch(libraries);
for (const width of [1280, 390]) {
  for (const dark of [false, true]) {
    const { page, trouble, close } = await open(browser, file, { width, dark });
    const sections = page.locator('main section:visible');
    for (let i = 0; i < (await sections.count()); ++i) {
      const section = sections.nth(i);
      const id = await section.getAttribute('id');
      await section.scrollIntoViewIfNeeded();
      // Figures are drawn when they come near.
      for (const figure of await section.locator('figure').all()) {
        await figure.scrollIntoViewIfNeeded();
        await figure.locator('.drawing canvas, .drawing svg').first().waitFor();
      }
      await section.screenshot({ path: path.join(folder, `${id}-${width}-${dark ? 'dark' : 'light'}.png`) });
    }
    await page.evaluate(() => scrollTo(0, 0));
    await page.screenshot({ path: path.join(folder, `top-${width}-${dark ? 'dark' : 'light'}.png`) });
    for (const line of trouble) console.log(`${width} ${dark ? 'dark' : 'light'}: ${line}`);
    await close();
  }
}
await browser.close();
