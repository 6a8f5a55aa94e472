// Screenshot of the page of a running program: node e2e/shot.mjs URL PICTURE [FILE.rviz]
import { browser, open } from './lib.mjs';

const [url, picture, rviz] = process.argv.slice(2);
const chrome = await browser();
try {
  const { page } = await open(chrome, url);
  await page.waitForFunction(() => window.periplus?.displays.length > 1, undefined, {
    timeout: 60_000,
  });
  if (rviz) await page.getByTestId('rviz-file').setInputFiles(rviz);
  // Waits for rare messages, such as maps.
  await page.waitForTimeout(8000);
  await page.screenshot({ path: picture });
} finally {
  await chrome.close();
}
