// A search through all documents, this one first, for passages with all words in any order,
// whatever their endings; Enter goes from find to find.
const MAX_FINDS = 12;
// What people ask for in words that a document may not have, and what it has instead.
const INSTEAD = [[/^(run[ -]?times?|how long)$/i, "\\b(?:seconds|minutes|µs)\\b"]];
const ABBREVIATED = { eq: "\\beq(?:s?\\.|uations?)", fig: "\\bfig(?:s?\\.|ures?)", sec: "\\bsec(?:s?\\.|tions?)" };
// Signs with several spellings; between others a text may have signs of mathematical markup.
const SPELT = { "σ": "(?:σ|sigma)", "½": "(?:½|1/2)" };
const MARKUP = "[_^{}$]*";
const folded = (word) => word.replace(/[_^{}$\\]/g, "").replace(/sigma/gi, "σ").replaceAll("1/2", "½");
const CONTEXT = 50;
const found = make("ol");
const input = make("input", { type: "search", placeholder: "Search all documents" });
input.setAttribute("aria-label", "Search all documents");
const here = location.pathname.split("/").pop();
// Words up to the first sign that may be mathematics, whose text on the page is another.
const plain = (text) => text.match(/^[\p{Script=Latin}\d ,.;:()-]*/u)[0] || text;
let [texts, next] = [undefined, 0];
input.addEventListener("input", async () => {
  await (texts ??= load("search.js"));
  const typed = input.value.trim();
  const [, instead] = INSTEAD.find(([words]) => words.test(typed)) ?? [];
  const asked = typed.split(/\s+/).map(folded).filter((word) => word !== "");
  const stem = (word) => (/^\p{L}{5,}$/u.test(word) ? word.replace(/(ies|ing|ed|es|s|y|e)$/i, "") : word);
  // Equations, figures and sections are found as people abbreviate them.
  const abbreviated = (word) => ABBREVIATED[word.toLowerCase().replace(/s?\.$/, "")];
  const ends = (word) => (/^\p{N}+$/u.test(word) ? "(?!\\p{N})" : "\\p{L}*");
  const sign = (one) => SPELT[one] ?? one.replace(/[.*+?()|[\]]/, "\\$&");
  const pattern = (word) => abbreviated(word) ?? `(?<![\\p{L}\\p{N}])${[...stem(word)].map(sign).join(MARKUP)}${ends(word)}`;
  const patterns = instead ? [instead] : asked.map(pattern);
  const words = patterns.map((word) => new RegExp(word, "iu"));
  const phrase = new RegExp(patterns.join("[^\\p{L}\\p{N}]+"), "iu");
  const is_short = asked.join("").length < 2;
  const pages = is_short ? [] : TEXTS.toSorted((a, b) => (b[0] === here) - (a[0] === here));
  // Where no passage has all words, those that have most of them.
  const count = (text) => words.filter((word) => word.test(text)).length;
  const most = Math.max(0, ...pages.flatMap(([, , pieces]) => pieces.map(([, , text]) => count(text))));
  const places = pages.flatMap(([page, name, pieces]) => pieces.flatMap(([id, section, text]) => {
    if (most === 0 || 2 * most < words.length || count(text) < most) return [];
    const whole = phrase.exec(text);
    const { index: at, 0: match } = whole ?? words.find((word) => word.test(text)).exec(text);
    const end = at + match.length;
    const before = text.slice(Math.max(0, at - CONTEXT), at).replace(at > CONTEXT ? /^\S*\s/ : "", "");
    const after = text.slice(end, end + CONTEXT).replace(text.length > end + CONTEXT ? /\s\S*$/ : "", "");
    const where = page === here ? section : `${name}: ${section}`;
    const shown = make("small", {}, before, make("mark", {}, text.slice(at, end)), after);
    // The words of a heading stand in the contents too: its id leads there.
    const words_at = text === section ? "" : `:~:text=${encodeURIComponent(plain(text.slice(at, end + CONTEXT)).replace(/\s\S*$/, "")).replaceAll("-", "%2D")}`;
    return [[`${page}#${id}${words_at}`, where, shown, (whole !== null) + (whole?.index === 0)]];
  }));
  // First what begins with the words, as the equation itself, then where they follow one another.
  places.sort((a, b) => b[3] - a[3]);
  next = 0;
  const lines = places.slice(0, MAX_FINDS).map(([href, where, shown]) => make("li", {}, make("a", { href }, where, make("br"), shown)));
  if (lines.length > 0 && most < words.length) lines.unshift(make("li", {}, make("small", {}, "near matches; no passage has all words")));
  const more = places.length - MAX_FINDS;
  if (more > 0) lines.push(make("li", {}, make("small", {}, `${more} more: add a word`)));
  if (places.length === 0 && !is_short) lines.push(make("li", {}, make("small", {}, "nothing found")));
  found.replaceChildren(...lines);
});
input.addEventListener("keydown", ({ key }) => {
  const finds = all("a", found);
  if (key === "Enter" && finds.length > 0) finds[next++ % finds.length].click();
});
if (sections.length > 0) contents.prepend(make("div", { className: "search", role: "search" }, input, found));

