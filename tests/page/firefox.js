// The site in Firefox: opens it in every size and appearance, and prints what is wrong, one sentence a line.
// node firefox.js NODE_FOLDER FIREFOX SITE_ADDRESS PICTURE_FOLDER EXPECTED_TIME
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [folder, executablePath, address, pictures, expected] = process.argv.slice(2);
const require = createRequire(`${folder}/`);
const puppeteer = require("puppeteer-core").default ?? require("puppeteer-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf-8");

const APPEARANCES = {
  light: { "layout.css.prefers-color-scheme.content-override": 1 },
  dark: { "layout.css.prefers-color-scheme.content-override": 0 },
  forced: { "browser.display.document_color_use": 2 },
  large: { "layout.css.devPixelsPerPx": "2" },
};
const SIZES = [
  [390, 844],
  [820, 1180],
  [1440, 900],
];
const SETTLED = "plan.dataset.drawn !== undefined && plan.dataset.rested === plan.dataset.drawn";
const LINK = "#pose=-400,120,90&orbit=0,0,120&turn=either&airspeed=18&bank=35&wind=8,250";

const faults = [];
let checked = 0;

async function open(browser, url, [width, height] = SIZES[2]) {
  const page = await browser.newPage();
  await page.setViewport({ width, height });
  page.on("pageerror", (error) => faults.push(`${url}: ${error}`));
  page.on("request", (request) => {
    if (!request.url().startsWith(address) && !/^(file|data|blob|about):/.test(request.url())) faults.push(`${url} asked for ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForFunction(SETTLED, { timeout: 120_000 });
  return page;
}

/** What axe finds that is serious or critical. */
async function graveOf(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(() => globalThis.axe.run().then(({ violations }) => violations));
  return found.filter(({ impact }) => impact === "serious" || impact === "critical");
}

for (const [name, extraPrefsFirefox] of Object.entries(APPEARANCES)) {
  const browser = await puppeteer.launch({ browser: "firefox", executablePath, headless: true, extraPrefsFirefox });
  for (const size of SIZES) {
    const where = `${name}, ${size[0]} px`;
    const page = await open(browser, address, size);
    const time = await page.evaluate("document.getElementById('time').innerText");
    if (time !== expected) faults.push(`${where}: the time is ${time} instead of ${expected}`);
    const wide = await page.evaluate("document.documentElement.scrollWidth - innerWidth");
    if (wide > 0) faults.push(`${where}: the page is ${wide} px wider than the screen`);
    for (const { id, nodes } of await graveOf(page)) faults.push(`${where}: axe: ${id}: ${nodes[0].html}`);
    await page.screenshot({ path: `${pictures}/firefox-${name}-${size[0]}.png` });
    await page.close();
    checked += 1;
  }
  if (name === "light") {
    // After the first visit no server is needed.
    const page = await open(browser, address);
    await page.evaluate("navigator.serviceWorker.ready.then(() => true)");
    await page.reload();
    process.stdout.write("STOP\n"); // the server
    await new Promise((resolve) => process.stdin.once("data", resolve));
    await page.goto(address + LINK);
    await page.reload();
    await page.waitForFunction(SETTLED, { timeout: 120_000 });
    if ((await page.evaluate("plan.dataset.failure")) !== "") faults.push("offline: no plan");
    process.stdout.write("START\n");
    await new Promise((resolve) => process.stdin.once("data", resolve));
    await page.close();
    checked += 1;
  }
  await browser.close();
}
for (const fault of faults) process.stdout.write(`${fault}\n`);
process.stdout.write(`${checked} visits in Firefox, ${faults.length} faults\n`);
process.exit(faults.length ? 1 : 0);
