// Where things stand on a screen, and what a narrow one folds.
import { cpSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

/** All that is tried. */
export async function layout({ browser, report, open, check }) {
  await first_screen_has_all(open, check);
  await rows_are_folded(open, check);
  await figures_are_enlarged(open, check);
  await errors_say_the_digits(open, check);
  await copy_has_no_dead_links(browser, report, check);
}

/** The finding, the score and both pictures of the live chain are on the first screen. */
async function first_screen_has_all(open, check) {
  const page = await open("index.html", 1280, "light", { loads: true, reducedMotion: "reduce" });
  if ((await page.locator(".lab").count()) > 0) {
    await page.locator(".bench output").filter({ hasText: /of our chains/ }).waitFor({ timeout: 8000 }).catch(() => check(false, "no live chain on the front page"));
    for (const what of ["main > p:first-child + ul", "table.bar", ".pair canvas >> nth=0", ".pair canvas >> nth=1"]) {
      const { y, height } = await page.locator(what).boundingBox();
      check(y + height <= 800, `${what} ends at ${y + height} of the first screen`);
    }
  }
  await page.context().close();
}

/** On a phone the rows of a very long table are shut; a tap or a key opens one, and paper has all. */
async function rows_are_folded(open, check) {
  const page = await open("methods.html", 390, "light");
  const row = page.locator("tr.shut").first();
  check((await page.locator("tr.shut").count()) > 10, "long tables are not folded on a phone");
  const cells = row.locator("td:visible");
  check((await cells.count()) === 1, "a row that is shut shows more than its key");
  const key = page.locator(".turn").first();
  await key.click();
  check((await key.getAttribute("aria-expanded")) === "true" && (await page.locator("tr:has(.turn[aria-expanded=true]) td:visible").count()) > 4, "a tap opens no row");
  await key.press("Enter");
  check((await key.getAttribute("aria-expanded")) === "false", "a key shuts no row");
  await page.emulateMedia({ media: "print" });
  check((await cells.count()) > 4, "a row that is shut is not printed");
  await page.context().close();
  const plain = await open("methods.html", 390, "light", { javaScriptEnabled: false });
  check((await plain.locator("tr.shut").count()) === 0, "without scripts rows are folded");
  await plain.context().close();
}

/** On a phone a figure can be seen larger, in a box that scrolls. */
async function figures_are_enlarged(open, check) {
  const page = await open("report.html", 390, "light");
  const box = page.locator("#fig-3 > .scroll");
  const width = () => box.locator("svg").evaluate((svg) => svg.getBoundingClientRect().width);
  const before = await width();
  await page.locator("#fig-3 .enlarge").click();
  check((await width()) > 1.8 * before, "a figure gets no larger");
  check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "a larger figure widens the page");
  await page.locator("#fig-3 .enlarge").click();
  check((await width()) === before, "a figure stays large");
  await page.context().close();
}

/** A value that is read from a figure has the digits that its error leaves. */
async function errors_say_the_digits(open, check) {
  const page = await open("report.html", 1280, "light");
  const picture = page.locator("#fig-3 svg");
  await page.keyboard.press("Shift");
  await picture.focus();
  await page.locator("#fig-3 .point").waitFor({ state: "attached", timeout: 5000 }).catch(() => check(false, "no point of a figure is shown"));
  const reading = page.locator("#fig-3 .reading").filter({ hasText: "\u00b1" });
  for (let i = 0; i < 5 && (await reading.count()) === 0; i += 1) await page.keyboard.press("ArrowDown");
  const words = await reading.innerText().catch(() => "");
  const [, value, error] = words.match(/: ([\d.]+) \u00b1 ([\d.]+)/) ?? [];
  const decimals = (number) => number?.split(".")[1]?.length ?? 0;
  check(error !== undefined && decimals(value) === decimals(error) && error.replace(/^[0.]+/, "").replace(".", "").length <= 2, `a reading says ${words}`);
  await page.context().close();
}

/** In a folder without its project no link leads out of it. */
async function copy_has_no_dead_links(browser, report, check) {
  // A report that was made outside a project has none from the start.
  if (!readFileSync(join(report, "report.html"), "utf8").includes('href="../')) return;
  const folder = mkdtempSync(join(tmpdir(), "report-"));
  cpSync(report, folder, { recursive: true });
  const page = await browser.newPage();
  await page.goto(pathToFileURL(join(folder, "report.html")).href);
  await page.locator(".imprint").filter({ hasText: "a copy" }).first().waitFor({ timeout: 5000 }).catch(() => check(false, "a copy of the folder does not say that it is one"));
  const dead = () => page.locator("main a[href^='../'], footer a[href^='../'], #card a[href^='../']").count();
  check((await dead()) === 0, `a copy of the folder has ${await dead()} links out of it`);
  await page.locator(".value").first().click();
  await page.locator("#card").waitFor({ timeout: 5000 });
  check((await dead()) === 0, "a card in a copy of the folder has links out of it");
  await page.close();
  rmSync(folder, { recursive: true });
}
