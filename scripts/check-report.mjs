// The checks of check-report.sh: a browser is driven through its own protocol, over the WebSocket that Node brings.

import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [browser, report, shots, plant] = process.argv.slice(2);

// Sizes of a phone, of a laptop and of a desk.
const VIEWS = [
  { name: "phone", width: 390, height: 844, dark: false },
  { name: "laptop", width: 1280, height: 800, dark: false },
  { name: "desk", width: 1400, height: 900, dark: false },
  { name: "desk-dark", width: 1400, height: 900, dark: true },
];

// Faults to plant, and a word of the complaint that each must cause.
const FAULTS = [
  ["<script>throw new Error('planted')</script>", "error"],
  ["<img src=\"https://example.invalid/x.png\">", "fetched"],
  ["<div style=\"width:3000px\">planted</div>", "overflows"],
  ["<div class=\"scroll\"><div style=\"width:3000px\">planted</div></div>", "too wide for its box"],
  ["<style>.compare .over { clip-path: none !important }</style>", "slider"],
  ["<script>document.querySelectorAll('.mark, .track svg').forEach((m) => m.remove())</script>", "marks"],
  ["<script>document.querySelectorAll('thead button').forEach((b) => b.remove())</script>", "sort"],
];

// What to take screenshots of.
const SIGHTS = [
  ["top", "h1"], ["answers", "#s-what-should-i-use"], ["matrix", "#s-strategies-by-scenes"], ["chart", ".chart:has(.front)"],
  ["point", "details"], ["time", "details:has(> .scroll > .bars)"], ["pictures", ".gallery"], ["cases", "#s-hard-cases"],
  ["outside", "#s-outside-baselines"], ["made", "#s-how-it-was-made"],
];

/** Speaks the protocol of the browser's page. */
class Page {
  constructor(socket) {
    this.socket = socket;
    this.waiting = new Map();
    this.heard = [];
    this.last = 0;
    socket.addEventListener("message", ({ data }) => {
      const message = JSON.parse(data);
      if (message.id) {
        const { done, failed } = this.waiting.get(message.id);
        this.waiting.delete(message.id);
        message.error ? failed(new Error(message.error.message)) : done(message.result);
      } else {
        this.heard.push(message);
      }
    });
  }

  ask(method, params = {}) {
    this.last += 1;
    this.socket.send(JSON.stringify({ id: this.last, method, params }));
    return new Promise((done, failed) => this.waiting.set(this.last, { done, failed }));
  }

  async evaluate(expression) {
    const answer = await this.ask("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (answer.exceptionDetails) throw new Error(answer.exceptionDetails.exception?.description ?? "no answer");
    return answer.result.value;
  }

  async until(event) {
    for (let tries = 0; tries < 600; tries += 1) {
      if (this.heard.some((m) => m.method === event)) return;
      await pause(50);
    }
    throw new Error(`${event} never came`);
  }
}

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** A browser with a profile of its own, and the first page of it. */
async function open() {
  const profile = mkdtempSync(join(tmpdir(), "check-report-"));
  const flags = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--remote-debugging-port=0", `--user-data-dir=${profile}`, "about:blank",
  ];
  const child = spawn(browser, flags, { stdio: ["ignore", "ignore", "pipe"] });
  const address = await new Promise((done, failed) => {
    let said = "";
    child.stderr.on("data", (chunk) => {
      said += chunk;
      const found = said.match(/DevTools listening on ws:\/\/([^/]+)/);
      if (found) done(found[1]);
    });
    child.on("exit", () => failed(new Error(`the browser ended: ${said}`)));
  });
  const pages = await (await fetch(`http://${address}/json`)).json();
  const socket = new WebSocket(pages.find((p) => p.type === "page").webSocketDebuggerUrl);
  await new Promise((done) => socket.addEventListener("open", done));
  const page = new Page(socket);
  const close = async () => {
    child.removeAllListeners("exit");
    const ended = new Promise((done) => child.on("exit", done));
    child.kill();
    await ended;
    rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  };
  return { page, close };
}

/** What the page itself can be asked. Runs in the page; returns complaints. */
function complaints() {
  const found = [];
  const root = document.documentElement;
  if (root.scrollWidth > root.clientWidth) {
    found.push(`the page overflows: ${root.scrollWidth} px in ${root.clientWidth} px`);
  }
  // On a phone tables scroll in their own boxes; elsewhere none has to.
  if (root.clientWidth > 1000) {
    for (const box of document.querySelectorAll(".scroll")) {
      if (box.offsetParent !== null && box.scrollWidth > box.clientWidth + 1) {
        found.push(`too wide for its box: ${box.getAttribute("aria-label")}, ${box.scrollWidth} px in ${box.clientWidth} px`);
      }
    }
  }
  const charts = [...document.querySelectorAll(".chart")];
  for (const chart of charts) {
    const marks = chart.querySelectorAll(".mark").length;
    if (marks === 0) found.push(`no marks in the chart ${chart.querySelector("figcaption").textContent}`);
  }
  for (const track of document.querySelectorAll(".ranking tbody .track")) {
    if (!track.querySelector("svg")) found.push("no marks in a ranking");
  }
  const tables = [...document.querySelectorAll("table.grid")].filter((t) => t.tBodies[0].rows.length > 2);
  for (const table of tables) {
    const last = table.tHead.rows[0].cells.length - 1;
    for (const column of [0, 1, last]) {
      const button = table.tHead.rows[0].cells[column].querySelector("button");
      if (!button) {
        found.push("a table does not sort: no button");
        break;
      }
      const keys = () => [...table.tBodies[0].rows]
        .map((row) => row.cells[column].dataset.key)
        .filter((key) => key !== undefined)
        .map(Number);
      for (const sign of [1, -1]) {
        button.click();
        const sorted = keys().every((key, i, all) => i === 0 || sign * (key - all[i - 1]) >= 0);
        if (!sorted) found.push(`a table does not sort: ${table.parentElement.getAttribute("aria-label")}`);
      }
    }
  }
  const images = document.querySelectorAll(".shots img").length;
  const sliders = [...document.querySelectorAll(".compare")];
  for (const slider of sliders) {
    const range = slider.querySelector("input");
    const over = slider.querySelector(".over");
    const clips = ["20", "80"].map((value) => {
      range.value = value;
      range.dispatchEvent(new Event("input"));
      return getComputedStyle(over).clipPath;
    });
    if (clips[0] === clips[1]) found.push("a slider does not move its clip");
  }
  return { found, counts: { charts: charts.length, tables: tables.length, images, sliders: sliders.length } };
}

/** Pictures under a slider: shown once in view, and chosen by name. Runs in the page. */
async function compares() {
  const slider = document.querySelector(".compare");
  if (!slider) return [];
  for (let up = slider.closest("details"); up; up = up.parentElement.closest("details")) up.open = true;
  slider.scrollIntoView({ behavior: "instant", block: "center" });
  await new Promise((done) => setTimeout(done, 500));
  const over = slider.querySelector(".over");
  await over.decode().catch(() => {});
  const found = [];
  if (!(over.naturalWidth > 0)) found.push("the slider shows no picture");
  const select = slider.parentElement.querySelector("select");
  const before = over.src;
  select.value = String(select.options.length - 1);
  select.dispatchEvent(new Event("change"));
  if (over.src === before) found.push("the slider does not take another picture");
  return found;
}

async function check(url, isLookedAt) {
  const { page, close } = await open();
  const all = [];
  try {
    await Promise.all(["Page", "Runtime", "Network", "Log"].map((domain) => page.ask(`${domain}.enable`)));
    for (const view of VIEWS) {
      page.heard.length = 0;
      await page.ask("Emulation.setDeviceMetricsOverride", {
        width: view.width, height: view.height, deviceScaleFactor: 1, mobile: view.width < 600,
      });
      const features = [{ name: "prefers-color-scheme", value: view.dark ? "dark" : "light" }];
      await page.ask("Emulation.setEmulatedMedia", { features });
      await page.ask("Page.navigate", { url });
      await page.until("Page.loadEventFired");
      const shut = await page.evaluate(`(${complaints})()`);
      // What is folded can overflow too.
      await page.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })");
      const opened = await page.evaluate(`(${complaints})()`);
      const found = new Set([...shut.found, ...opened.found, ...(await page.evaluate(`(${compares})()`))]);
      for (const { method, params } of page.heard) {
        if (method === "Runtime.exceptionThrown") found.add(`an error: ${params.exceptionDetails.exception?.description}`);
        if (method === "Runtime.consoleAPICalled") found.add(`the console says: ${params.args[0]?.value}`);
        if (method === "Log.entryAdded" && params.entry.level === "error") found.add(`an error: ${params.entry.text}`);
        if (method === "Network.requestWillBeSent") {
          const asked = params.request.url;
          if (asked !== url && !asked.startsWith("data:") && !asked.startsWith("file:")) found.add(`fetched: ${asked}`);
        }
      }
      all.push(...[...found].map((f) => `${view.name}: ${f}`));
      if (isLookedAt) {
        const { charts, tables, images, sliders } = opened.counts;
        console.log(`${view.name}: ${charts} charts, ${tables} tables that sort, ${images} pictures, ${sliders} sliders`);
        await look(page, view, url);
      }
    }
  } finally {
    await close();
  }
  return all;
}

/** Screenshots of the parts of a page, as it is when it is opened. */
async function look(page, view, url) {
  mkdirSync(shots, { recursive: true });
  page.heard.length = 0;
  await page.ask("Page.navigate", { url: "about:blank" });
  page.heard.length = 0;
  await page.ask("Page.navigate", { url });
  await page.until("Page.loadEventFired");
  for (const [name, selector] of SIGHTS) {
    const isThere = await page.evaluate(`(() => {
      const target = document.querySelector(${JSON.stringify(selector)});
      if (target?.matches("details")) target.open = true;
      target?.scrollIntoView({ behavior: "instant" });
      return Boolean(target);
    })()`);
    if (!isThere) continue;
    await pause(600);
    const { data } = await page.ask("Page.captureScreenshot", { format: "png" });
    writeFileSync(join(shots, `${view.name}-${name}.png`), Buffer.from(data, "base64"));
  }
}

if (plant) {
  const folder = mkdtempSync(join(tmpdir(), "check-report-planted-"));
  let missed = 0;
  for (const [fault, word] of FAULTS) {
    const copy = join(folder, "planted.html");
    writeFileSync(copy, readFileSync(report, "utf8").replace("</body>", () => `${fault}</body>`));
    const found = await check(pathToFileURL(copy).href, false);
    const isFound = found.some((complaint) => complaint.includes(word));
    missed += isFound ? 0 : 1;
    console.log(`${isFound ? "found" : "MISSED"}: ${fault}`);
  }
  rmSync(folder, { recursive: true });
  process.exit(missed === 0 ? 0 : 1);
}
const found = await check(pathToFileURL(resolve(report)).href, true);
found.forEach((complaint) => console.error(complaint));
console.log(found.length === 0 ? `nothing to complain of; screenshots are in ${shots}` : `${found.length} complaints`);
process.exit(found.length === 0 ? 0 : 1);
