// What readers run themselves: the same bits as the program computed when it made the report, soon,
// and refused in words.
import { readFileSync } from "node:fs";
import { join } from "node:path";

/** Rows of a CSV file, whose first field may be quoted. */
const rows = (text) => text.trim().split("\n").slice(1).map((line) => line.match(/("[^"]*"|[^,"]+)(?=,|$)/g).map((cell) => cell.replaceAll('"', "")));

/** Waits until it is there, or says that it was not. */
const appears = (locator, check, what) =>
  locator.waitFor({ timeout: 8000 }).catch(async () => check(false, `${what}: ${(await locator.page().locator(".bench output").allInnerTexts()).join(" ")}`));

/** All that is tried. */
export async function labs({ report, open, check, stays_narrow, accessible, pictures }) {
  const offered = async (file, options) => {
    const page = await open(file, 1280, "light", options);
    const count = await page.locator(".lab:visible").count();
    await page.context().close();
    return count;
  };
  if (!readFileSync(join(report, "index.html"), "utf8").includes('class="lab"')) {
    console.log("note: the pages were made without a module, so nothing is run in them");
    return;
  }
  const module = readFileSync(join(report, "lab.js"), "utf8").match(/"module":"([^"]*)"/)[1];
  check(module.length * 0.75 <= 400 * 1000, `lab.js: a module of ${module.length * 0.75} bytes`);
  check((await offered("index.html", { javaScriptEnabled: false })) === 0, "without scripts a lab is offered");
  check((await offered("index.html", { before: () => delete globalThis.WebAssembly })) === 0, "without WebAssembly a lab is offered");

  const tried = async ([file, lab, width, scheme]) => {
    const name = `${file} lab ${width}`;
    const page = await open(file, width, scheme, { loads: true, reducedMotion: "reduce" });
    await page.evaluate(() => {
      globalThis.long = [];
      new PerformanceObserver((list) => long.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: "longtask" });
    });
    const figure = page.locator(`#lab-${lab}`);
    // The front page begins by itself.
    if (file !== "index.html") {
      check((await page.locator("script[src*='lab.js']").count()) === 0, `${name}: lab.js is loaded unasked`);
      await figure.locator("button").focus();
      await page.keyboard.press("Enter");
    }
    await appears(figure.locator("output").first().filter({ hasText: /\d/ }), check, `${name}: nothing is run`);
    const reached = await figure.locator("input").first().evaluate((own) => own === document.activeElement);
    check(reached === (file !== "index.html"), `${name}: the first slider is ${reached ? "" : "not "}reached`);
    await (lab === "chain" ? chains : circuits)(page, name, figure, { report, check, stays_narrow });
    const seen = () => figure.locator("canvas").evaluateAll((all) => all.map((one) => one.toDataURL()).join());
    const before = await seen();
    await page.waitForTimeout(300);
    check(before === (await seen()), `${name}: it moves by itself`);
    const long = await page.evaluate(() => Math.max(0, ...globalThis.long));
    console.log(`note: ${name}: the page sleeps for ${long} ms at most`);
    await stays_narrow(page, name);
    await accessible(page, name);
    if (pictures) await figure.screenshot({ path: `${pictures}/${name}.png` });
    await page.emulateMedia({ media: "print" });
    check(!(await figure.isVisible()), `${name}: it is printed`);
    await page.context().close();
  };
  await Promise.all([["index.html", "chain", 1280, "light"], ["beyond.html", "chain", 390, "dark"]].map(tried));
  await masses_move(open, check);
  await link_shows_chain(open, check);
  await Promise.all([["report.html", "theory", 1280, "dark"], ["report.html", "theory", 390, "light"]].map(tried));
}

async function typed(figure, label, value) {
  await figure.getByLabel(`${label}, typed`).fill(value);
  await figure.getByLabel(`${label}, typed`).press("Enter");
}

async function chains(page, name, figure, { report, check, stays_narrow }) {
  const [told, proof] = [figure.locator("output").nth(0), figure.locator("output").nth(1)];
  const data = (what) => figure.locator(".bench").evaluate((bench, what) => bench.dataset[what], what);
  const set = (label, value) => typed(figure, label, value);
  await figure.locator("summary").click();
  const choice = figure.getByLabel("Runs of this edition");

  // Every digest that the program found when it made this report.
  const runs = rows(readFileSync(join(report, "data/replay-runs.csv"), "utf8"));
  check(runs.length >= 10, `${name}: only ${runs.length} runs to repeat`);
  for (const [i, [run, , , impacts, distinct, , , digest]] of runs.entries()) {
    await choice.selectOption(String(i));
    await appears(proof.filter({ hasText: "✓ same bits" }).locator(`code[title="${digest}"]`), check, `${name}: ${run}: not the bits of the program`);
    const words = (await told.innerText()).replaceAll(",", "");
    check(words.startsWith(`${distinct} of`) && words.endsWith(`in all: ${impacts}.`), `${name}: ${run}: ${words}`);
  }
  check(Number(await data("bytes")) < 32e6, `${name}: the module takes ${await data("bytes")} bytes`);
  // A page whose digest is another must say so.
  await page.evaluate(() => (LAB.runs[0].found.digest = LAB.runs[1].found.digest));
  await choice.selectOption("0");
  await appears(proof.filter({ hasText: "NOT the same" }), check, `${name}: other bits are called the same`);

  // Another chain is another run, and no run of this edition.
  await figure.getByRole("button", { name: "Another chain" }).click();
  await appears(told.filter({ hasText: "gaps have impacts" }), check, `${name}: no other chain`);
  check((await choice.inputValue()) === "", `${name}: another chain is called ${await choice.inputValue()}`);

  await times_move_the_curves(figure, told, check, name, set);
  await states_have_an_address(page, figure, check, name, set);
  await many_are_run(figure, check, name);
  await stays_narrow(page, `${name}, many`);

  // From slider to picture, by keyboard.
  await figure.getByLabel("force σ (dω²)", { exact: true }).focus();
  let slowest = 0;
  for (let i = 0; i < 20; i += 1) {
    const digest = await data("digest");
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction(([id, digest]) => document.querySelector(`#${id} .bench`).dataset.digest !== digest, [await figure.getAttribute("id"), digest]);
    slowest = Math.max(slowest, Number(await data("time")));
  }
  console.log(`note: ${name}: ${slowest.toFixed(0)} ms from slider to picture at most, n = 100`);

  // A thousand masses for long, given up for another run half-way; then as much memory as before.
  await set("masses n", "1000");
  await set("wait T", "9000");
  await appears(told.filter({ hasText: "so far" }), check, `${name}: nothing is told on the way`);
  await set("wait T", "100");
  await appears(told.filter({ hasText: "of 1001 gaps" }).filter({ hasNotText: "so far" }), check, `${name}: a run is not given up for another`);
  check(Number(await data("bytes")) < 32e6, `${name}: the module takes ${await data("bytes")} bytes`);

  for (const [label, value] of [["force σ", ""], ["force σ", "-1"], ["masses n", "0"], ["masses n", "1001"], ["masses n", "2.5"], ["wait T", "1e9"], ["count for W", "0"], ["restitution r", "2"]]) {
    const good = await figure.getByLabel(`${label}, typed`).inputValue();
    await set(label, value);
    await appears(told.filter({ hasText: "is not allowed; give a" }), check, `${name}: ${label} = ${value}`);
    check((await told.innerText()).startsWith(`${label} = ${value || "nothing"} `), `${name}: ${await told.innerText()}`);
    await set(label, good);
    await appears(told.filter({ hasText: "gaps have impacts" }).filter({ hasNotText: "so far" }), check, `${name}: it does not go on after ${label} = ${value}`);
  }
}

/** Sliders of T and W go from one computed pair to the next, and the page says where its rise lies; elsewhere what the curves hold for. */
async function times_move_the_curves(figure, told, check, name, set) {
  const said = figure.locator("output").filter({ hasText: /mean of our chains|faint curves/ });
  const last = await figure.evaluate(() => Math.max(...LAB.protocols.map(({ protocol }) => protocol.transient)));
  const places = [];
  for (const key of ["Home", "End"]) {
    await figure.getByLabel("wait T (1/ω)", { exact: true }).press(key);
    await appears(said.filter({ hasText: key === "Home" ? "At T = 10 " : `At T = ${last} ` }), check, `${name}: ${key} of T`);
    places.push(Number((await said.innerText()).match(/at σ = (\d\.\d+)\(/)?.[1] ?? 0));
  }
  check(places[0] > 0.12 && places[1] < places[0], `${name}: the rise lies at ${places}`);
  await set("wait T", "500");
  await appears(said.filter({ hasText: /At T = 500 and W = 200 .* jumps to all gaps at 0\.11/ }), check, `${name}: no jump at our times`);
  await set("restitution r", "0.7");
  await appears(said.filter({ hasText: "for n = 100, r = 0.8, T = 500, W = 200; for your settings" }), check, `${name}: curves hold for r = 0.7`);
  await set("restitution r", "0.8");
  await appears(told.filter({ hasNotText: "so far" }), check, `${name}: not back at r = 0.8`);
}

/** What is set stands in the address and in a command, and the address sets it. */
async function states_have_an_address(page, figure, check, name, set) {
  await set("force σ", "0.1");
  await set("realisation", "3");
  await appears(figure.locator("code").filter({ hasText: "impact-paper sweep --sigma 0.1 --realisations 3..4" }), check, `${name}: no command`);
  const hash = await page.evaluate(() => location.hash);
  check(hash === "#chain:sigma=0.1&T=500&W=200&realisation=3", `${name}: the address says ${hash}`);
  await page.evaluate(() => (location.hash = "#chain:sigma=0.2&T=1000"));
  await appears(figure.locator("output").filter({ hasText: "t = 1,000 to 1,200" }).filter({ hasNotText: "so far" }), check, `${name}: an address sets nothing`);
  check((await figure.getByLabel("force σ, typed").inputValue()) === "0.2", `${name}: an address sets no σ`);
  await figure.getByRole("button", { name: "Copy link" }).click();
  await appears(figure.getByRole("button", { name: /Copied|Selected/ }), check, `${name}: no link is copied`);
  await page.evaluate(() => (location.hash = "#chain:sigma=0.12"));
  await appears(figure.locator("output").filter({ hasText: "t = 500 to 700" }).filter({ hasNotText: "so far" }), check, `${name}: no way back`);
}

/** Twenty chains at each σ, with progress, until they are stopped; a change forgets them. */
async function many_are_run(figure, check, name) {
  const told = figure.locator(".many output");
  await figure.getByRole("button", { name: /^Run \d+ chains/ }).click();
  await appears(told.filter({ hasText: /^\d+ of \d+ chains/ }), check, `${name}: no progress`);
  check(await figure.locator("progress").isVisible(), `${name}: no bar of progress`);
  await figure.getByRole("button", { name: "Stop" }).click();
  await appears(figure.getByRole("button", { name: /^Run \d+ chains/ }), check, `${name}: it does not stop`);
  check(!(await figure.locator("progress").isVisible()), `${name}: progress of nothing`);
}

/** A shared link shows its chain at the top of a phone. */
async function link_shows_chain(open, check) {
  const page = await open("index.html#chain:sigma=0.13&T=1000", 390, "light", { loads: true });
  await appears(page.locator(".bench output").filter({ hasText: "t = 1,000 to 1,200" }).filter({ hasNotText: "so far" }), check, "a link runs nothing");
  await page.waitForTimeout(300);
  const top = await page.locator("#lab-chain").evaluate((lab) => lab.getBoundingClientRect().top);
  check(top >= 0 && top < 100, `a link shows its chain at ${top}`);
  await page.context().close();
}

/** A row of masses moves by itself unless a reader prefers it still, and stops when asked to. */
async function masses_move(open, check) {
  const page = await open("index.html", 1280, "light", { loads: true });
  const canvas = page.locator(".row canvas");
  const seen = () => canvas.evaluate((one) => one.toDataURL());
  await appears(page.locator(".row span").filter({ hasText: "t =" }), check, "no row of masses");
  const place = () => page.locator(".cursor").evaluate((cursor) => parseFloat(cursor.style.left));
  const [before, first] = [await seen(), await place()];
  await page.waitForTimeout(400);
  check(before !== (await seen()), "the row of masses does not move");
  check((await place()) > first, "no cursor shows its time");
  await page.locator(".row").getByRole("button", { name: "Pause" }).click();
  const still = await seen();
  await page.waitForTimeout(300);
  check(still === (await seen()), "a row that is stopped moves");
  await page.context().close();
}

async function circuits(page, name, figure, { report, check }) {
  const told = figure.locator("output");
  const set = (label, value) => typed(figure, label, value);
  const text = (of) => readFileSync(join(report, `data/theory-${of}.csv`), "utf8");
  const [table, header] = [(of) => rows(text(of)), (of) => text(of).split("\n")[0].split(",")];
  const at = async (p) => {
    await set("probability p", String(p));
    return told.innerText();
  };
  // As the edition has them for Fig. 8, and on both sides of the jump.
  for (const [p, mean] of table("distribution")) {
    const words = await at(p);
    check(Math.abs(Number(words.match(/μ = ([\d.]+)\. /)?.[1]) / mean - 1) < 1e-3, `${name}: p = ${p}: ${words}, not ${mean}`);
  }
  const column = (name) => header("jump").findIndex((head) => head.startsWith(`${name} `));
  const [p_jump, k_after] = ["p_jump", "k_after"].map((name) => table("jump")[0][column(name)]);
  const sides = [await at(p_jump * (1 - 1e-12)), await at(p_jump * (1 + 1e-12))];
  check(sides[0].startsWith("k* = 1,") && sides[1].startsWith(`k* = ${k_after},`), `${name}: beside the jump: ${sides}`);
  await set("vertices N", "1000");
  await appears(told.filter({ hasText: /leaves 1 at p = 0\.00/ }), check, `${name}: N = 1000`);
  for (const [label, value] of [["probability p", ""], ["probability p", "1.5"], ["vertices N", "3"], ["vertices N", "5000"]]) {
    await set(label, value);
    check((await told.innerText()).startsWith(`${label} = ${value || "nothing"} is not allowed; give a`), `${name}: ${label} = ${value}: ${await told.innerText()}`);
    await set(label, label.startsWith("p") ? "0.016" : "100");
  }
  await set("probability p", "0");
}
