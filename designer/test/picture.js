// docs/designer.png: run by designer/picture.sh.

import { join } from 'node:path';
import { test } from 'node:test';
import { ROOT, drawn, open, page, ready, setUp, written } from './harness.js';

setUp();

test('the picture is made', async () => {
  await open('', { width: 1440, height: 1000 });
  await page.emulateMediaFeatures([{ name: 'prefers-reduced-motion', value: 'reduce' }]);
  await page.reload();
  await ready();
  await page.click('#example');
  await page.says('the curve explains the trace');
  await page.$eval('body', (it) => it.scrollIntoView());
  await page.mouse.move(2, 2);
  await written();
  await drawn();
  await page.screenshot({ path: join(ROOT, 'docs', 'designer.png') });
});
