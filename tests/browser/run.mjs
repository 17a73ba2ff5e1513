// Opens the pages of a report from disk in headless Chromium, as a reader would, and ends with exit
// code 1 if something is wrong. Usage: node run.mjs FOLDER [FOLDER FOR PICTURES]
import { chromium } from "playwright-core";
import { createRequire } from "node:module";
import { existsSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { labs } from "./lab.mjs";
import { tasks } from "./tasks.mjs";
import { layout } from "./layout.mjs";

const report = resolve(process.argv[2] ?? "../../paper");
const pictures = process.argv[3];
/** What each page has at least: figures, links inside it, equations, elements at most, bytes at most. */
const PAGES = {
  // Of its bytes most are the picture that stands there without script.
  "index.html": { figures: 1, links: 4, equations: 0, elements: 15_000, bytes: 240 * 1024 },
  "report.html": { figures: 15, links: 150, equations: 39, elements: 15_000, bytes: 800 * 1024 },
  "beyond.html": { figures: 5, links: 50, equations: 9, elements: 18_000, bytes: 800 * 1024 },
  "methods.html": { figures: 3, links: 20, equations: 0, elements: 15_000, bytes: 800 * 1024 },
  "ledger.html": { figures: 0, links: 70, equations: 0, elements: 15_000, bytes: 800 * 1024 },
};
const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const executable = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);

const faults = [];
const check = (good, what) => {
  if (!good) faults.push(what);
};

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? executable,
  args: process.getuid?.() === 0 ? ["--no-sandbox"] : [],
});

/** A page whose requests and complaints are checked. */
async function open(file, width, colorScheme, { before, loads, ...options } = {}) {
  const page_url = new URL(file, `${pathToFileURL(report)}/`).href;
  const context = await browser.newContext({
    viewport: { width, height: width < 400 ? 844 : 900 },
    colorScheme,
    ...options,
  });
  if (before) await context.addInitScript(before);
  const page = await context.newPage();
  page.on("request", (request) => {
    const url = request.url();
    const beside = url.slice(new URL(".", page_url).href.length);
    const asked = /^(report\.css|report\.js|cards\.js|search\.js|points\.js|fonts\/[^/]*\.woff2)$/.test(beside) || ((loads || file === "index.html") && beside === "lab.js");
    // Whether the project is around the folder.
    const around = url.endsWith("/CONTRIBUTING.md");
    check(asked || around || request.isNavigationRequest() || url.split("#")[0] === page_url.split("#")[0] || url.startsWith("data:"), `a request: ${url.slice(0, 100)}`);
  });
  page.on("console", (message) => {
    check(!["error", "warning"].includes(message.type()), `console: ${message.text()}`);
  });
  page.on("pageerror", (error) => check(false, `script: ${error}`));
  await page.goto(page_url);
  await page.evaluate(() => document.fonts.ready.then(() => undefined));
  return page;
}

/** Fonts are those of the report, figures have a size and fall into the page, links land. */
async function reads_well(page, name, least) {
  const found = await page.evaluate(() => {
    const wrong = [];
    for (const face of document.fonts)
      if (face.status !== "loaded" && face.style === "normal" && face.family === "Libertinus Serif") wrong.push(`font ${face.family} ${face.weight}: ${face.status}`);
    const figures = [...document.querySelectorAll("svg[role=img]")].filter((svg) => !svg.closest(".runs .front figure:has(+ .lab, + figure + .lab)"));
    for (const svg of figures) {
      const box = svg.getBoundingClientRect();
      const inner = svg.getBBox();
      if (box.width < 200 || box.height < 60 || inner.width === 0 || !svg.checkVisibility())
        wrong.push(`${svg.getAttribute("aria-labelledby")} is not seen: ${box.width} x ${box.height}`);
    }
    const links = [...document.querySelectorAll('a[href^="#"]:not(.bench a)')];
    for (const link of links) {
      const target = document.getElementById(decodeURIComponent(link.hash.slice(1)));
      if (!target || !target.checkVisibility()) wrong.push(`${link.hash} does not land`);
    }
    return { wrong, figures: figures.length, links: links.length, elements: document.querySelectorAll("*").length };
  });
  found.wrong.forEach((wrong) => check(false, `${name}: ${wrong}`));
  check(found.figures >= least.figures, `${name}: ${found.figures} figures`);
  check(found.links >= least.links, `${name}: ${found.links} links`);
  check(found.elements <= least.elements, `${name}: ${found.elements} elements`);
  const { size } = statSync(join(report, name.split(" ")[0]));
  check(size <= least.bytes, `${name}: ${size} bytes`);
}

/** Nothing but boxes that scroll by themselves is wider than the screen. */
async function stays_narrow(page, name) {
  const wide = await page.evaluate(() => {
    const width = document.documentElement.clientWidth;
    if (document.documentElement.scrollWidth <= width) return [];
    const inside = (node) => node.parentElement?.closest(".scroll, pre, svg, .card, nav");
    return [...document.querySelectorAll("main *, header *, nav *")]
      .filter((node) => node.getBoundingClientRect().right > width + 1 && !inside(node))
      .slice(0, 5)
      .map((node) => `${node.tagName} ${node.className} ${node.textContent.slice(0, 40)}`)
      .concat(`the page is ${document.documentElement.scrollWidth} wide`);
  });
  check(wide.length === 0, `${name} scrolls sideways: ${wide.join(" | ")}`);
  const towers = await page.evaluate(() => {
    const words = document.createRange();
    const height = (cell) => {
      words.selectNodeContents(cell);
      return words.getBoundingClientRect().height;
    };
    return [...document.querySelectorAll("main td")]
      .filter((cell) => cell.clientWidth < 120 && height(cell) > 180)
      .map((cell) => `${cell.clientWidth} x ${height(cell)} ${cell.textContent.slice(0, 30)}`);
  });
  check(towers.length === 0, `${name}: ${towers.length} cells of tables are towers: ${towers.slice(0, 3).join(" | ")}`);
}

/** A displayed equation fits into its box on a wide screen and on paper; on a narrow screen the box scrolls from its start to its end. */
async function equations_fit(page, name, least) {
  const { width } = page.viewportSize();
  for (const media of ["screen", "print"]) {
    await page.emulateMedia({ media });
    const [count, cut, wide] = await page.evaluate(() => {
      const all = [...document.querySelectorAll(".equation")];
      const over = (equation) => {
        const box = equation.querySelector(".scroll");
        const inner = [...box.querySelectorAll("math, .value")].map((part) => part.getBoundingClientRect());
        const { left, right } = box.getBoundingClientRect();
        return Math.max(box.scrollWidth - box.clientWidth, ...inner.map((part) => Math.max(part.right - right, left - part.left)));
      };
      const wide = all.filter((equation) => over(equation) > 1);
      const cut = all.filter((equation) => {
        const box = equation.querySelector(".scroll");
        box.scrollLeft = 1e6;
        const end = over(equation) < 1 || getComputedStyle(box).overflowX === "auto";
        box.scrollLeft = 0;
        const first = box.querySelector("math, .value").getBoundingClientRect().left;
        return !end || first < box.getBoundingClientRect().left - 1;
      });
      return [all.length, cut.length, wide.map((equation) => `${equation.id} ${equation.textContent.slice(0, 40)} by ${over(equation).toFixed(0)}`)];
    });
    check(count >= least.equations, `${name}, ${media}: ${count} equations`);
    check(media === "print" || cut === 0, `${name}: ${cut} equations are cut`);
    check(width < 1000 || wide.length === 0, `${name}, ${media}: ${wide.length} equations are wider than their boxes: ${wide.join(" | ")}`);
  }
  await page.emulateMedia({ media: "screen" });
}

/** On a narrow screen the contents open without a wider page. */
async function contents_open(page, name) {
  const contents = page.locator(".contents > details");
  if ((await contents.count()) === 0 || (await contents.evaluate((details) => details.open))) return;
  await contents.locator("> summary").click();
  await stays_narrow(page, `${name}, contents`);
  await contents.locator("> summary").click();
}

/** The card of a number lies inside the window, wherever the number is, and closes. */
async function cards_stay_inside(page, name) {
  const wrong = await page.evaluate(async () => {
    const [card, wrong] = [document.getElementById("card"), []];
    const is_open = () => card.matches(":popover-open");
    const frame = () => new Promise(requestAnimationFrame);
    for (const [i, button] of document.querySelectorAll(".value").entries()) {
      if (i % (i < 40 ? 4 : 100) !== 0) continue;
      for (const block of ["start", "center", "end"]) {
        button.scrollIntoView({ block, behavior: "instant" });
        if (!button.checkVisibility()) continue;
        button.click();
        for (let waited = 0; waited < 300 && !is_open(); waited += 1) await frame();
        // A card that has no room below its number moves above it.
        await frame();
        await frame();
        const { left, top, right, bottom, height } = card.getBoundingClientRect();
        if (left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1 || height < 60) wrong.push(`the card of ${button.innerText} is out of sight: ${[left, top, right, bottom]}`);
        const lead = card.querySelector(":scope > p").innerText;
        if (!/^[A-Z].*\.$/.test(lead)) wrong.push(`a card begins with ${lead}`);
        card.querySelector("[popovertargetaction=hide]").click();
        if (is_open()) wrong.push("Close closes no card");
      }
    }
    return wrong;
  });
  wrong.forEach((what) => check(false, `${name}: ${what}`));
}

/** A number is reached and opened by keyboard alone, and closes again. */
async function opens_by_keyboard(page, name) {
  const button = page.locator(".value").first();
  if ((await button.count()) === 0) return;
  const id = "card";
  for (let i = 0; i < 80; i += 1) {
    await page.keyboard.press("Tab");
    if (await button.evaluate((node) => node === document.activeElement)) break;
  }
  check(await button.evaluate((node) => node === document.activeElement), `${name}: no key leads to a number`);
  const shown = () => page.evaluate((id) => document.getElementById(id).matches(":popover-open"), id);
  check(!(await shown()), `${name}: a card is open before it was asked for`);
  await page.keyboard.press("Enter");
  await page.locator(`#${id}`).waitFor({ timeout: 5000 }).catch(() => check(false, `${name}: Enter opens no card`));
  const box = await page.locator(`#${id}`).boundingBox();
  const view = page.viewportSize();
  check(
    box && box.width > 100 && box.x >= 0 && box.y >= 0 && box.x + box.width <= view.width + 1 && box.y + box.height <= view.height + 1,
    `${name}: the card is out of sight: ${JSON.stringify(box)}`,
  );
  if (pictures) await page.screenshot({ path: `${pictures}/${name} card.png` });
  await page.emulateMedia({ media: "print" });
  check(!(await page.locator(`#${id}`).isVisible()), `${name}: an open card is printed on each page`);
  await page.emulateMedia({ media: "screen" });
  await page.keyboard.press("Escape");
  check(!(await shown()), `${name}: Escape closes no card`);
}

/** A number in a PDF leads to its card on the page. */
async function opens_by_address(page, name) {
  const id = await page.locator(".value").first().getAttribute("data-card");
  await page.evaluate((id) => (location.hash = `#value:${encodeURIComponent(id)}`), id);
  await page.locator("#card").waitFor({ timeout: 5000 }).catch(() => check(false, `${name}: no card of ${id} by its address`));
  await page.keyboard.press("Escape");
}

/** Arrow keys go from number to number in a table, which is one stop of the Tab key, and from verdict to verdict, each large enough for a finger. */
async function tables_are_one_stop(page, name) {
  const stops = await page.evaluate(() =>
    [...document.querySelectorAll("table, .front main > p:first-child + ul")].map((group) => group.querySelectorAll(":is(.value, a.verdict[data-card]):not([tabindex='-1'])").length),
  );
  check(stops.every((count) => count <= 1), `${name}: tables of ${Math.max(...stops)} stops`);
  const small = await page.evaluate(() =>
    [...document.querySelectorAll("td > .verdict:is(:has(+ .verdict), .verdict + .verdict)")].map((sign) => sign.getBoundingClientRect()).filter(({ width, height }) => Math.min(width, height) < 23.9).length,
  );
  check(small === 0, `${name}: ${small} signs are too small for a finger`);
  const table = page.locator("table:has(.value ~ *, td + td .value)").first();
  if ((await table.count()) === 0) return;
  const buttons = table.locator(".value");
  if ((await buttons.count()) < 2) return;
  await buttons.first().focus();
  await page.keyboard.press("ArrowRight");
  check(await buttons.nth(1).evaluate((node) => node === document.activeElement), `${name}: ArrowRight goes to no number`);
  await page.keyboard.press("ArrowLeft");
  check(await buttons.first().evaluate((node) => node === document.activeElement), `${name}: ArrowLeft does not go back`);
}

/** A reference that is pointed at shows what it means, and hides it again. */
async function references_are_seen(page, name) {
  const link = page.locator('main p a[href^="#eq-"], main p a[href^="#fig-"]').first();
  if ((await link.count()) === 0) return;
  await link.scrollIntoViewIfNeeded();
  const look = page.locator("#look");
  for (const [show, hide] of [
    [() => link.hover(), () => page.mouse.move(0, 0)],
    [() => page.keyboard.press("Shift").then(() => link.focus()), () => page.keyboard.press("Escape")],
  ]) {
    await show();
    await look.waitFor({ timeout: 5000 }).catch(async () => check(false, `${name}: no look at ${await link.innerText()}`));
    const text = await look.innerText();
    check(text.length > 10, `${name}: a look at nothing`);
    await hide();
    await look.waitFor({ state: "hidden", timeout: 5000 }).catch(() => check(false, `${name}: a look stays`));
  }
}

/** The search finds words in any order, marks them, finds no parts of words, and says when it finds nothing. */
async function search_finds(page, name) {
  const input = page.getByRole("searchbox");
  const finds = page.locator(".search li a");
  for (const words of ["impact", "sudden impacting number"]) {
    await input.fill(words);
    await finds.first().waitFor({ timeout: 5000 }).catch(() => check(false, `${name}: the search does not find ${words}`));
    check((await finds.count()) === (await finds.locator("mark").count()), `${name}: what is found is not marked`);
  }
  for (const [words, first] of [["Eq. (18)", /Eq(uation|\.)\s\(18\)/], ["Fig. 3", /Figure 3\./], ["run time", /seconds|minutes|µs/i]]) {
    await input.fill(words);
    await finds.first().filter({ hasText: first }).waitFor({ timeout: 5000 }).catch(async () => check(false, `${name}: ${words} finds first ${await finds.first().innerText().catch(() => "nothing")}`));
  }
  for (const words of ["mpact", "xylophones"]) {
    await input.fill(words);
    const lines = await page.locator(".search li").allTextContents();
    check(lines.join() === "nothing found", `${name}: the search finds ${words}: ${lines}`);
  }
}

/** A verdict opens the card of its statement, which leads to its row: open, marked, below the head of the table. */
async function verdicts_open(page, name) {
  await page.locator("a.verdict[data-card]").first().click();
  const card = page.locator("#card");
  await card.waitFor({ timeout: 5000 }).catch(() => check(false, `${name}: a verdict opens no card`));
  const text = await card.innerText();
  check(text.includes("paper") && text.includes("here"), `${name}: the card of a verdict says ${text}`);
  await card.locator("a", { hasText: "the row" }).click();
  await page.waitForURL(/ledger\.html#claim-/);
  const row = page.locator("tr:has(:target)");
  const [box, head] = [await row.boundingBox(), await page.locator("#tab-claims thead").boundingBox()];
  check(box.y >= head.y + head.height - 1 && box.y < 900, `${name}: the row of a statement is out of sight`);
  check((await row.locator("details:not([open])").count()) === 0, `${name}: the row of a statement is folded`);
}

/** The ledger shows only rows of a verdict when it is asked, and what is gone to by its address. */
async function filters(page) {
  const [all, shown] = [page.locator("#tab-claims tbody tr"), page.locator("#tab-claims tbody tr:visible")];
  await page.getByLabel("verdict").selectOption("≠ differs and explained (range)");
  const some = await shown.count();
  check(some > 0 && some < (await all.count()), `ledger: ${some} rows differ`);
  const words = await shown.locator("td:nth-child(5)").allInnerTexts();
  check(words.every((word) => word === "≠ differs and explained (range)"), `ledger: rows of other verdicts: ${words}`);
  await page.evaluate(() => (location.hash = "#claim-sec7_jump"));
  await page.waitForTimeout(200);
  check((await shown.count()) === (await all.count()), "ledger: a row that is gone to stays hidden");
}

async function accessible(page, name) {
  await page.addScriptTag({ path: axe });
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"], preload: false }));
  for (const rule of found.violations) {
    const grave = ["serious", "critical"].includes(rule.impact);
    const nodes = rule.nodes.slice(0, 3).map((node) => `${node.html.slice(0, 120)} (${node.failureSummary?.split("\n")[1]?.trim()})`);
    const text = `${name}: axe ${rule.id} (${rule.impact}), ${rule.nodes.length} times: ${nodes.join(" | ")}`;
    if (grave) check(false, text);
    else console.log(`note: ${text}`);
  }
}

/** A figure says its points to who points at it, or goes with the arrow keys, and its numbers are found by a search in the page. */
async function figures_are_read(page, name) {
  const all = page.locator("figure svg:visible:has([data-axes])");
  if ((await all.count()) === 0) return;
  // Where there are very many points none is named.
  let picture = all.first();
  for (let i = 0; i < (await all.count()) && (await page.locator(".point").count()) === 0; i++) {
    picture = all.nth(i);
    await picture.focus();
    await page.keyboard.press("Shift");
    await page.keyboard.press("ArrowRight");
    await picture.locator(".point").waitFor({ state: "attached", timeout: 3000 }).catch(() => undefined);
  }
  await picture.blur();
  const reading = page.locator("figure:has(svg[data-axes]), figure:has([data-axes])").locator(".reading").filter({ hasText: /\d/ });
  await picture.focus();
  await page.keyboard.press("Shift");
  await page.keyboard.press("ArrowRight");
  await reading.first().waitFor({ timeout: 5000 }).catch(() => check(false, `${name}: no key reads a figure`));
  const readings = new Set();
  for (const key of ["Shift", "ArrowLeft", "ArrowRight"]) {
    await page.keyboard.press(key);
    readings.add(await reading.first().innerText().catch(() => ""));
  }
  check(readings.size > 1, `${name}: arrows go to no other point`);
  const { x, y, width } = await picture.locator(".point").boundingBox();
  await picture.blur();
  await page.mouse.move(x + width / 2 - 1, y + width / 2);
  await page.mouse.move(x + width / 2, y + width / 2);
  await reading.first().waitFor({ timeout: 5000 }).catch(() => check(false, `${name}: a figure that is pointed at says nothing`));
  await page.mouse.move(0, 0);
  const words = await picture.locator(".said").first().textContent();
  check(await page.evaluate((words) => (getSelection().removeAllRanges(), window.find(words)), words), `${name}: a search in the page does not find ${words}`);
}

/** What others see of a link to the page. */
async function introduces_itself(page, name) {
  const content = (what) => page.locator(`meta[${what}]`).getAttribute("content");
  const words = await content("name=description");
  check(words.length > 60 && words.length < 1500, `${name}: described as ${words}`);
  for (const what of ["title", "description", "type"]) check((await content(`property='og:${what}'`)).length > 3, `${name}: no og:${what}`);
  check(existsSync(join(report, await content("property='og:image'").catch(() => "figures"))), `${name}: no picture to share`);
  check((await page.locator("link[rel=icon]").getAttribute("href")).startsWith("data:image/svg+xml,"), `${name}: no icon`);
  const foot = await page.locator(".imprint").innerText();
  for (const what of ["Report a problem", "original", "licence", "Markdown"]) check(foot.includes(what), `${name}: the foot lacks ${what}`);
}

/** What was found, the score and the slider stand on the first two screens of a phone. */
async function begins_with_the_finding(page, name) {
  await page.locator(".bench canvas").first().waitFor({ timeout: 8000 }).catch(() => {});
  const bottoms = await page.evaluate(() => ["main > p:first-child + ul", "table.bar", ".bench input"].map((what) => {
    const box = document.querySelector(what)?.getBoundingClientRect();
    return box ? Math.round(box.bottom + scrollY) : Infinity;
  }));
  check(bottoms[2] <= 2 * 844 && bottoms[0] < bottoms[1] && bottoms[1] < bottoms[2], `${name}: finding, score and slider end at ${bottoms}`);
}

/** On paper no figure is a thumbnail. */
async function prints(page, name) {
  await page.emulateMedia({ media: "print" });
  const small = await page.evaluate(() => [...document.querySelectorAll("figure:not(.lab) svg")].filter((svg) => svg.checkVisibility()).map((svg) => svg.getBoundingClientRect().width).filter((width) => width < 200).length);
  check(small === 0, `${name}: ${small} thumbnails on paper`);
  const pdf = await page.pdf({ format: "A4", preferCSSPageSize: true, ...(pictures ? { path: `${pictures}/${name}.pdf` } : {}) });
  check(pdf.length > 20_000, `${name}: ${pdf.length} bytes of print`);
  await page.emulateMedia({ media: "screen" });
}

/** Reads a page of a width as people do. */
async function read([file, least], [kind, width, scheme]) {
  const name = `${file} ${kind}`;
  const page = await open(file, width, scheme);
  await reads_well(page, name, least);
  await stays_narrow(page, name);
  await equations_fit(page, name, least);
  await contents_open(page, name);
  if (pictures) await page.screenshot({ path: `${pictures}/${name}.png`, fullPage: file === "index.html" });
  // What else there is depends on one width or the other.
  if (["wide-light", "narrow-dark"].includes(kind)) {
    await cards_stay_inside(page, name);
    await opens_by_keyboard(page, name);
    await opens_by_address(page, name);
    await tables_are_one_stop(page, name);
    await references_are_seen(page, name);
    await search_finds(page, name);
    await accessible(page, name);
  }
  if (["wide-light", "phone-light"].includes(kind)) await figures_are_read(page, name);
  await introduces_itself(page, name);
  if (file === "index.html" && kind === "phone-light") await begins_with_the_finding(page, name);
  if (kind === "wide-light") await prints(page, name);
  if (file === "ledger.html" && kind === "wide-light") await filters(page);
  if (file === "index.html" && kind === "wide-light") await verdicts_open(page, name);
  await page.context().close();
}

// Two at a time, for two cores.
for (const of of Object.entries(PAGES)) {
  await Promise.all([["wide-light", 1440, "light"], ["narrow-dark", 320, "dark"]].map((kind) => read(of, kind)));
  await Promise.all([["middle-dark", 820, "dark"], ["phone-light", 390, "light"]].map((kind) => read(of, kind)));
}
await tasks({ report, open, check });
await layout({ browser, report, open, check });
await labs({ report, open, check, stays_narrow, accessible, pictures });

// Without scripts all that is to be read is there, and nothing looks as if it could be pressed.
for (const file of Object.keys(PAGES)) {
  const page = await open(file, 1280, "light", { javaScriptEnabled: false });
  if (file === "ledger.html") check((await page.locator("#tab-claims tbody tr:visible").count()) > 60, "without scripts the ledger lacks rows");
  check(await page.locator("main").isVisible(), `without scripts ${file} shows nothing`);
  const pressed = await page.evaluate(() => [...document.querySelectorAll("main :is(button, [role=button], .value)")].filter((node) => node.checkVisibility() && (node.matches("button, [role=button]") || getComputedStyle(node).textDecorationLine !== "none")).length);
  check(pressed === 0, `without scripts ${pressed} things in ${file} look like buttons`);
  if (file === "index.html") check((await page.locator("figure:not(.lab) svg:visible").count()) === 3, "without scripts the front page lacks a picture");
  await page.context().close();
}
await browser.close();

if (faults.length > 0) {
  console.error([...new Set(faults)].join("\n"));
  console.error(`${new Set(faults).size} faults in ${report}`);
  process.exit(1);
}
console.log(`${report}: as it should be, wide and narrow, light and dark, with and without scripts`);
