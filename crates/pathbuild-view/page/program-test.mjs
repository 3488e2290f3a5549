// Tests programs dropped on the page without a server: node program-test.mjs HTML [PICTURES]; BROWSER=firefox tries Firefox.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import assert from "node:assert/strict";
import { isFirefox, launch } from "./browser.mjs";

const [html, pictures] = process.argv.slice(2).map((argument) => resolve(argument));
const place = mkdtempSync(join(tmpdir(), "pathbuild-programs-"));
const browser = await launch();

async function open(fragment = "", options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  await page.goto(`file://${html}${fragment}`);
  await page.waitForSelector("html[data-ready]");
  // From here on there must be no requests: dropped files stay on this machine.
  page.on("request", (request) => /^(data|blob):/.test(request.url()) || faults.push(request.url()));
  if ((await page.evaluate(() => document.documentElement.lang)) === "de" && !options.isGerman) await page.keyboard.press("l");
  return { page, faults };
}

async function shot(page, name) {
  await page.waitForTimeout(300);
  if (pictures) await page.screenshot({ path: join(pictures, `${name}${isFirefox ? "-firefox" : ""}.png`) });
}

const text = (page, selector) => page.locator(selector).innerText();
const shows = (page, title) => page.waitForFunction((title) => document.getElementById("title").textContent === title && !document.getElementById("viewer").hidden, title);
const says = (page, id, words) => page.waitForFunction(([id, words]) => document.getElementById(id).textContent.includes(words), [id, words]);

{
  const { page, faults } = await open();
  await shot(page, "program-empty");
  assert.match(await page.locator("#drop .book").getAttribute("href"), /docs\/en\//);
  // The example: its mistake with its line, what was checked, and what was assumed.
  await page.locator("#drop .example").click();
  await shows(page, "example.nc");
  assert.equal(await page.locator("#findings li").count(), 1);
  assert.match(await text(page, "#findings"), /line 34 · PB740/);
  assert.match(await text(page, "#checks"), /rapid moves.*6 mm \(header\)[^]*travel/);
  assert.equal(await page.locator("#checks .assumed").count(), 1);
  assert.match(await text(page, "#details"), /extent\s+X .*of which cuts\s+X 10 … 85, Y 0 … 30, Z -4 … 1/s);
  assert.equal(await page.locator("#assumedTool").getAttribute("placeholder"), "6");
  assert.equal(await page.locator("#assumedSurface").getAttribute("placeholder"), "0");
  assert.ok(await page.locator("#stock").isVisible());
  assert.equal(await page.locator("#labels .finding").count(), 1);
  await shot(page, "program-example");
  // A click on the finding goes to its line.
  await page.locator("#findings button").click();
  assert.match(await text(page, ".row.now"), /G0 X60/);
  // Sections by comments are operations.
  await page.locator("#work summary").click();
  assert.match(await text(page, "#operations"), /Pocket 1[^]*Pocket 2[^]*Slot/);
  // Another cutter, another surface: the program is checked again, and the view is kept.
  const there = await text(page, "#where");
  await page.locator("#assumedTool").fill("10");
  await page.locator("#assumedTool").press("Tab");
  await says(page, "checks", "10 mm (--cutter)");
  assert.equal(await text(page, "#where"), there);
  assert.match(await text(page, "#findings"), /PB740/);
  assert.match(page.url(), /#program&cutter=10$/);
  await page.locator("#assumedSurface").fill("-3");
  await page.locator("#assumedSurface").press("Tab");
  // The example states a higher one: this is reported, and the higher one counts.
  await says(page, "findings", "PB777");
  assert.match(await text(page, "#findings"), /PB740/);
  await page.locator("#assumedDialect").selectOption("grbl");
  await says(page, "details", "grbl");
  const link = await page.locator("#settings").getAttribute("href");
  assert.equal(link, "#program&dialect=grbl&cutter=10&surface=-3");
  // In German.
  await page.locator("#title").click();
  await page.keyboard.press("l");
  assert.match(await text(page, "#checks"), /Eilgänge/);
  assert.match(await page.locator("#drop .book").getAttribute("href"), /docs\/de\//);
  await shot(page, "program-german");
  await page.keyboard.press("l");
  // Back to the list, which is empty.
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#viewer").isHidden());
  assert.deepEqual(faults, []);
  await page.close();

  // The link contains the settings but no program: the page waits for one. It cuts below the surface of the settings, so that rapid moves are checked.
  const other = await open(link);
  assert.match(await text(other.page, "#trouble"), /settings, but no program/);
  writeFileSync(join(place, "mine.tap"), "G21 G90 G94 G17\nG0 Z5\nG0 X0 Y0\nG1 Z-4 F100\nG1 X20\nG0 X40\nG0 Z5\nM30\n");
  await other.page.setInputFiles("#drawings", join(place, "mine.tap"));
  await shows(other.page, "mine.tap");
  await says(other.page, "checks", "10 mm (--cutter)");
  assert.equal(await other.page.locator("#assumedDialect").inputValue(), "grbl");
  assert.ok(await other.page.locator("#trouble").isHidden());
  assert.deepEqual(other.faults, []);
  await other.page.close();
}
{
  // Dropped with the mouse, under any name; broken programs get an answer as well.
  const { page, faults } = await open();
  const drop = (name, content) =>
    page.evaluate(([name, content]) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([content], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    }, [name, content]);
  const slot = (length) => `%\nO1000\nG21 G90 G94 G17\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X${length}\nG0 Z5\nM30\n%\n`;
  await drop("O1000", slot(20));
  await shows(page, "O1000");
  await page.locator("#assumedTool").fill("3");
  await page.locator("#assumedTool").press("Tab");
  await says(page, "findings", "");
  // A newer version of the program keeps the entered cutter; another program does not have it.
  await drop("O1000", slot(30));
  await says(page, "details", "X 0 … 30");
  assert.equal(await page.locator("#assumedTool").inputValue(), "3");
  await drop("nonsense.nc", "\u0000\u0001 <img src=x onerror=alert(1)> G1 X");
  await shows(page, "nonsense.nc");
  assert.equal(await page.locator("#assumedTool").inputValue(), "");
  assert.ok((await page.locator("#findings li").count()) > 0);
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // On a phone, dark, in German.
  const options = isFirefox ? {} : { colorScheme: "dark", locale: "de", hasTouch: true };
  const { page, faults } = await open("", { viewport: { width: 390, height: 800 }, isGerman: !isFirefox, ...options });
  await shot(page, "program-empty-390");
  const tapped = () =>
    page.evaluate(() => {
      const all = [...document.querySelectorAll("button:not(.finding), select, input, summary, .row, a")].filter((node) => node.offsetParent !== null);
      return all.map((node) => [node.id || node.className || node.tagName, node.getBoundingClientRect()]).filter(([, { width, height }]) => width < 43.9 || height < 43.9).map(([name, { width, height }]) => `${name} ${width}x${height}`);
    });
  assert.deepEqual(await tapped(), []);
  await page.locator("#drop .example").click();
  await shows(page, "example.nc");
  assert.deepEqual(await tapped(), []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await shot(page, "program-390");
  assert.deepEqual(faults, []);
  await page.close();
}
if (isFirefox) {
  // The animation works here as well.
  const { page } = await open();
  await page.locator("#drop .example").click();
  await shows(page, "example.nc");
  await page.keyboard.press("Home");
  await page.locator("#play").click();
  await page.waitForFunction(() => /^Move [1-9]/.test(document.getElementById("where").textContent));
  await page.locator("#play").click();
  await page.keyboard.press("3");
  await shot(page, "program-space");
  assert.ok(await page.evaluate(() => document.querySelector("#picture canvas:not(#flat)") !== null), "WebGL2");
  await page.close();
}
await browser.close();
rmSync(place, { recursive: true });
console.log(`programs on the page${isFirefox ? ", in Firefox" : ""}: all passed`);
