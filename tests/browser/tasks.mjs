// What a reviewer wants to do with a report, from the front page, by three clicks or keys at most.
import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

/** All words in sight. */
const in_sight = () =>
  [...document.querySelectorAll("h1, main :is(p, li, td, h2, h3, figcaption, output), footer :is(p, pre, button), #card, body > table td")]
    .filter((node) => node.checkVisibility() && node.getBoundingClientRect().bottom > 0 && node.getBoundingClientRect().top < innerHeight)
    .map((node) => node.innerText.normalize("NFKC").replaceAll(/\s+/g, " "))
    .join("\n");

/** Tasks: what is done (a word that is clicked, or what is typed into a field), and what is seen then. */
const TASKS = {
  "read statement 27": [[{ type: "statement 27" }, "Enter"], /^27$[^]*qualitatively/m],
  "know the number of realisations": [[{ type: "number of realisations" }, "Enter"], /number of realisations per value of \S+ is \d+/],
  "know the licence": [[{ type: "licence" }, "Enter"], /Licence: text, figures and data/],
  "go from Eq. (25) to its line of code": [["Eq. (25)", "(25)"], /, line \d+/],
  "find the original": [["Edition", "Homer & Hogan, 2007"], /Homer, M\., & Hogan, S\. J\. \(2007\)\. Impact dynamics/],
  "cite this edition": [["How to cite", "Copy"], /(Copied|Selected)\n@misc\{[a-z0-9]+,/],
  "have the data of a figure": [["data of the figures", "fig12.csv"], /^series \(text\),/],
  "choose a method": [["Methods"], /a mean over many chains Verlet/],
  "run the chain at σ = 0.1": [[{ type: "0.1", into: "force σ, typed" }, "Fig. 3 at σ = 0.1, realisation 3"], /^[1-9]\d* of 101 gaps have impacts[^]*✓ same bits/m],
  "learn what becomes of grazing": [[{ type: "grazing" }, "Enter"], /graz/],
};

/** Does one thing. A link to a file that no page shows gives the text of the file. */
async function act(page, action) {
  if (action.type !== undefined) {
    await (action.into ? page.getByLabel(action.into) : page.getByRole("searchbox")).fill(action.type);
    await page.locator(".search li a").first().waitFor({ timeout: action.into ? 1 : 8000 }).catch(() => {});
  } else if (action === "Enter") {
    await page.keyboard.press("Enter");
  } else {
    const words = new RegExp(`^\\s*${action.replaceAll(/[().]/g, "\\$&").replaceAll(" ", "\\s")}\\s*$`);
    const target = page.locator("a, button, summary").filter({ hasText: words, visible: true }).first();
    const file = (await target.getAttribute("href", { timeout: 8000 })) ?? "";
    if (file.endsWith(".csv")) return readFileSync(fileURLToPath(new URL(file, page.url())), "utf8");
    await target.click();
  }
}

/** Tries all tasks on a wide screen and on a phone. */
export async function tasks({ open, check }) {
  const at = async (width) => {
    for (const [task, [actions, expected]] of Object.entries(TASKS)) {
      const page = await open("index.html", width, "light", { loads: true });
      let [text, seen] = ["", ""];
      for (const action of actions) text = (await act(page, action).catch((error) => check(false, `${width}: ${task}: ${error}`))) ?? "";
      for (let waited = 0; waited < 80 && !expected.test(seen); waited += 1) {
        await page.waitForTimeout(100);
        seen = text || (await page.evaluate(in_sight).catch(() => ""));
      }
      check(actions.length <= 3 && expected.test(seen), `${width}: to ${task} fails; seen: ${seen.slice(0, 1500)}`);
      // Only a report in the project has links to its source.
      for (const link of await page.locator("#card a[href*='#L']").all()) {
        const [path, line] = (await link.getAttribute("href")).split("#L");
        check(existsSync(fileURLToPath(new URL(path, page.url()))) && Number(line) > 1, `${width}: ${task}: ${path}, line ${line}`);
      }
      await page.context().close();
    }
  };
  await Promise.all([1440, 390].map(at));
}
