// Measures the speed of the pages: node bench.mjs PATHBUILD LIBRARY. Needs Debian's chromium; benches/README.md explains the figures.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { launch } from "./browser.mjs";
import { serve } from "./serving.mjs";

const [pathbuild, library] = process.argv.slice(2).map((argument) => resolve(argument));
const place = mkdtempSync(join(tmpdir(), "pathbuild-bench-"));
const TURNS = 9;
const MOVES = 200_000;

const browser = await launch();

/** Median and maximum of some figures. */
function told(what, figures, unit) {
  const sorted = figures.toSorted((a, b) => a - b);
  const [middle, most] = [sorted[sorted.length >> 1], sorted.at(-1)].map((figure) => figure.toFixed(1));
  console.log(`${what}: middle ${middle} ${unit}, most ${most} ${unit}`);
}

async function fresh() {
  return (await browser.newContext({ viewport: { width: 1280, height: 800 }, locale: "en" })).newPage();
}

/** Time from entering the address to the first picture with rows. */
async function listing(address) {
  const figures = { first: [], all: [] };
  for (let turn = 0; turn < TURNS; turn++) {
    const page = await fresh();
    await page.addInitScript(() => {
      const note = (name, isDone) => {
        const look = () => (isDone() ? requestAnimationFrame(() => setTimeout(() => (window[name] = performance.now()))) : requestAnimationFrame(look));
        look();
      };
      note("first", () => document.querySelector(".item"));
      note("all", () => /[1-9].* paths$/.test(document.getElementById("count")?.textContent ?? ""));
    });
    await page.goto(address);
    await page.waitForFunction(() => window.first && window.all, undefined, { timeout: 60_000 });
    for (const name of ["first", "all"]) figures[name].push(await page.evaluate((name) => window[name], name));
    await page.context().close();
  }
  told("listing painted", figures.first, "ms");
  told("listing whole", figures.all, "ms");
}

/** Time from saving a drawing to its picture. */
async function edit(address) {
  const drawings = readdirSync(library, { recursive: true }).filter((name) => /components.*\.dxf$/i.test(name)).sort();
  // Half of I: about twice as many moves.
  const halved = (drawing) => drawing.replace(/I0([.,])([2-9])/, (_, point, digit) => `I0${point}${digit >> 1}`);
  const read = (name) => readFileSync(join(library, name), "latin1");
  const name = drawings.find((name) => halved(read(name)) !== read(name));
  const [file, first] = [join(library, name), read(name)];
  const page = await fresh();
  await page.goto(`${address}#${new URLSearchParams({ file: name })}`);
  await page.waitForFunction(() => document.getElementById("slider").max > 0 && /paths$/.test(document.getElementById("count").textContent), undefined, { timeout: 60_000 });
  const figures = [];
  for (let turn = 0; turn < TURNS; turn++) {
    const moves = await page.locator("#slider").getAttribute("max");
    const changed = turn % 2 === 0 ? halved(first) : first;
    const done = page.waitForFunction((moves) => document.getElementById("slider").max !== moves && new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true)))), moves, { timeout: 60_000 });
    const begun = performance.now();
    writeFileSync(`${file}.new`, changed, "latin1");
    renameSync(`${file}.new`, file);
    await done;
    figures.push(performance.now() - begun);
    await page.waitForTimeout(500);
  }
  writeFileSync(file, first, "latin1");
  await page.context().close();
  told("edit to picture", figures, "ms");
}

/** A program with this many moves: zigzags on growing circles, pass by pass. */
function program() {
  const lines = ["%", "G21 G90 G94 G17", "G00 Z5", "G00 X0 Y0", "G01 Z-1 F100"];
  for (let move = lines.length; move < MOVES; move++) {
    const [angle, radius] = [move * 0.013, 20 + (move % 20_000) / 200 + (move % 2) * 3];
    const turn = move % 20_000 === 0 ? ` Z-${1 + move / 20_000}` : "";
    lines.push(`G01 X${(radius * Math.cos(angle)).toFixed(3)} Y${(radius * Math.sin(angle)).toFixed(3)}${turn} F300`);
  }
  return [...lines, "G00 Z5", "M30", "%", ""].join("\n");
}

/** Processor time of the whole browser in ms, which is more reliable than the clock on a busy machine. */
async function processorTime() {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  return processInfo.reduce((sum, { cpuTime }) => sum + cpuTime * 1000, 0);
}

const painted = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

/** Frames while the tool runs ten and a hundred times as fast as the machine. */
async function played(page, what) {
  for (const speed of ["10", "100"]) {
    const [rates, costs] = [[], []];
    for (let turn = 0; turn < 3; turn++) {
      await page.locator("#speed").selectOption(speed);
      await page.locator("#slider").fill(String(Math.round(MOVES * (0.2 + turn * 0.3))));
      await page.evaluate(painted);
      await page.locator("#play").click();
      const before = await processorTime();
      const { drawn, ms } = await page.evaluate(async () => {
        const begun = performance.now();
        let drawn = 0;
        for (; performance.now() - begun < 3000; drawn++) await new Promise(requestAnimationFrame);
        return { drawn, ms: performance.now() - begun };
      });
      costs.push(((await processorTime()) - before) / drawn);
      rates.push((drawn / ms) * 1000);
      await page.locator("#play").click();
    }
    told(`processor time a picture, running ${speed} times as fast, ${what}`, costs, "ms");
    told(`pictures a second, running ${speed} times as fast, ${what}`, rates, "");
    console.log(`the least: ${Math.min(...rates).toFixed(1)}`);
  }
}

/** Jumps to random moves, each until the picture is painted. */
async function jumped(page, what) {
  const figures = [];
  const before = await processorTime();
  for (let jump = 0; jump < 30; jump++) {
    figures.push(
      await page.evaluate(async (to) => {
        const slider = document.getElementById("slider");
        const begun = performance.now();
        slider.value = String(to);
        slider.dispatchEvent(new Event("input"));
        await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
        return performance.now() - begun;
      }, Math.round(MOVES * ((jump * 0.618) % 1))),
    );
  }
  told(`jump, ${what}`, figures, "ms");
  console.log(`processor time a jump, ${what}: ${(((await processorTime()) - before) / figures.length).toFixed(1)} ms`);
}

/** Frames while the tool runs along a long program. */
async function run() {
  writeFileSync(join(place, "long.gcode"), program());
  const viewed = spawnSync(pathbuild, ["view", "long.gcode", "-o", "long.html", "--no-cache"], { cwd: place, encoding: "utf8" });
  if (viewed.status !== 0) throw new Error(viewed.stderr);
  const page = await fresh();
  const begun = performance.now();
  await page.goto(`file://${join(place, "long.html")}`);
  await page.waitForSelector("html[data-ready]", { timeout: 60_000 });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  console.log(`${await page.locator("#slider").getAttribute("max")} moves opened: ${(performance.now() - begun).toFixed(0)} ms`);
  const client = await page.context().newCDPSession(page);
  await client.send("Performance.enable");
  const script = async () => (await client.send("Performance.getMetrics")).metrics.find((it) => it.name === "ScriptDuration").value * 1000;
  const [pictures, scripts] = [[], []];
  for (let turn = 0; turn < TURNS; turn++) {
    const before = await script();
    const { drawn, ms } = await page.evaluate(async (turn) => {
      const slider = document.getElementById("slider");
      const most = Number(slider.max);
      const next = () => new Promise(requestAnimationFrame);
      await next();
      const begun = performance.now();
      let drawn = 0;
      while (performance.now() - begun < 2000) {
        // Forwards and backwards, in large and small steps.
        const at = [0.3 + drawn / 500, 1 - drawn / 500, (drawn * 0.37) % 1][turn % 3];
        slider.value = String(Math.round(Math.min(Math.max(at, 0), 1) * most));
        slider.dispatchEvent(new Event("input"));
        await next();
        drawn++;
      }
      return { drawn, ms: performance.now() - begun };
    }, turn);
    scripts.push(((await script()) - before) / drawn);
    pictures.push((drawn / ms) * 1000);
  }
  told("pictures a second", pictures, "");
  console.log(`the least: ${Math.min(...pictures).toFixed(1)}`);
  told("script a picture", scripts, "ms");
  for (const cutter of ["", "2"]) {
    if (cutter) await page.locator("#assumedTool").fill(cutter);
    const what = cutter ? "with stock" : "without stock";
    await played(page, what);
    await jumped(page, what);
  }
  await page.context().close();
}

const { server, address } = await serve(pathbuild, library, "127.0.0.1:0");
await listing(address);
await edit(address);
server.kill();
await run();
await browser.close();
rmSync(place, { recursive: true });
