"use strict";
// Adds to a page: cards of numbers, previews of what is referred to, a search, filters.
{
  const all = (what, within = document) => [...within.querySelectorAll(what)];
  const make = (tag, properties = {}, ...children) => {
    const node = Object.assign(document.createElement(tag), properties);
    node.append(...children);
    return node;
  };

  // A page on a disk can load nothing but scripts, which are loaded when they are first needed.
  const load = (src) => new Promise((onload, onerror) => document.head.append(make("script", { src, onload, onerror })));

  // What readers can run; on the first page it starts by itself, in place of the figure before it,
  // which the style sheet hides from the beginning.
  let lab;
  for (const figure of all(".runs .lab")) {
    const status = figure.querySelector("[role=status]");
    const run = (asked) => (lab ??= load("lab.js")).then(() => open_lab(figure, asked));
    figure.hidden = false;
    figure.querySelector("button").addEventListener("click", () => {
      status.textContent = "Loading …";
      run(true).catch(() => {
        lab = undefined;
        status.textContent = "lab.js cannot be loaded; it belongs beside this page.";
      });
    });
    if (document.body.className === "front") run(false).catch(() => {
      lab = undefined;
      document.documentElement.className = "";
    });
  }

  // The card of a number.
  const card = document.getElementById("card");
  let cards;
  const open = async (value) => {
    await (cards ??= load("cards.js"));
    const [rows, all] = CARDS;
    const [title, lead, numbers] = all[value.dataset.card];
    card.querySelector("header span").innerHTML = title;
    card.querySelector("p").innerHTML = lead;
    card.querySelector("dl").innerHTML = numbers.map((number) => rows[number]).join("");
    card.hidePopover();
    card.showPopover({ source: value });
    card.scrollTop = 0;
  };
  const values = all("[data-card]");
  for (const sign of all("a[data-card]")) {
    sign.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      open(sign);
    });
  }
  for (const value of all(".value")) {
    value.addEventListener("click", () => open(value));
    value.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      open(value);
    });
  }
  // A number in a PDF leads to its card: report.html#value:ID.
  const asked = () => {
    const [kind, id] = decodeURIComponent(location.hash).split(/:(.*)/s);
    const value = kind === "#value" && values.find((value) => value.dataset.card === id);
    if (!value) return;
    value.scrollIntoView({ block: "center" });
    open(value);
  };
  addEventListener("hashchange", asked);

  // A table is one stop of the Tab key; arrows go from number to number.
  for (const table of all("table")) {
    const buttons = all(".value", table);
    buttons.slice(1).forEach((button) => (button.tabIndex = -1));
    const cell = (button) => button.closest("td, th");
    const steps = {
      ArrowRight: (at) => buttons[at + 1],
      ArrowLeft: (at) => buttons[at - 1],
      ArrowDown: (at) => buttons.find((button, i) => i > at && cell(button).cellIndex === cell(buttons[at]).cellIndex),
      ArrowUp: (at) => buttons.findLast((button, i) => i < at && cell(button).cellIndex === cell(buttons[at]).cellIndex),
    };
    table.addEventListener("keydown", (event) => {
      const at = buttons.indexOf(document.activeElement);
      const next = at < 0 ? undefined : steps[event.key]?.(at);
      if (!next) return;
      event.preventDefault();
      buttons.forEach((button) => (button.tabIndex = button === next ? 0 : -1));
      next.focus();
    });
  }

  // A preview of an equation, a figure, a table or a reference while a link to it is pointed at.
  const preview = document.getElementById("look");
  let waiting;
  const soon = (what) => {
    clearTimeout(waiting);
    waiting = setTimeout(what, 300);
  };
  const hide = () => preview.hidePopover();
  // A copy has no places, buttons or links of its own.
  const bare = (copy) => {
    all("[id]", copy).forEach((node) => node.removeAttribute("id"));
    all("[role=button], a", copy).forEach((node) => node.replaceWith(...node.childNodes));
    all("[tabindex]", copy).forEach((node) => node.removeAttribute("tabindex"));
    return copy;
  };
  const show = (link, target) => {
    preview.replaceChildren(bare(target.cloneNode(true)));
    preview.firstChild.removeAttribute("id");
    preview.showPopover({ source: link });
    // A long equation is as small as it must be.
    const box = preview.querySelector(".equation .scroll");
    if (box && box.scrollWidth > box.clientWidth) box.style.fontSize = `${(0.97 * box.clientWidth) / box.scrollWidth}em`;
  };
  for (const link of all('main a[href^="#"]')) {
    const target = document.getElementById(decodeURIComponent(link.hash.slice(1)));
    if (!target?.matches(".equation, figure, .references li") || target.contains(link)) continue;
    link.addEventListener("pointerenter", () => soon(() => show(link, target)));
    link.addEventListener("pointerleave", () => soon(hide));
    link.addEventListener("focus", () => link.matches(":focus-visible") && soon(() => show(link, target)));
    link.addEventListener("blur", () => soon(hide));
  }
  preview.addEventListener("pointerenter", () => clearTimeout(waiting));
  preview.addEventListener("pointerleave", () => soon(hide));
  addEventListener("keydown", ({ key }) => key === "Escape" && hide());

  // The contents mark the section that is being read.
  const contents = document.querySelector("nav.contents");
  const sections = all("main h2[id], main h3[id]");
  const mark = () => {
    const above = sections.findLast((section) => section.getBoundingClientRect().top < innerHeight / 3);
    for (const link of all("a", contents)) {
      const here = above !== undefined && link.hash === `#${above.id}`;
      // Only the contents scroll, where they have a scroll bar.
      if (here && !link.hasAttribute("aria-current")) contents.scrollTop = link.offsetTop - contents.clientHeight / 2;
      if (here) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  };
  let marking;
  addEventListener("scroll", () => {
    marking ??= requestAnimationFrame(() => {
      marking = undefined;
      mark();
    });
  }, { passive: true });

  // A search through all documents, this one first, for passages with all words in any order,
  // whatever their endings; Enter goes from find to find.
  const MAX_FINDS = 12;
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
    const asked = input.value.trim().split(/\s+/).filter((word) => word !== "");
    const stem = (word) => (/^\p{L}{5,}$/u.test(word) ? word.replace(/(ies|ing|ed|es|s|y|e)$/i, "") : word);
    const ends = (word) => (/^\p{N}+$/u.test(word) ? "(?!\\p{N})" : "\\p{L}*");
    const pattern = (word) => `(?<![\\p{L}\\p{N}])${stem(word).replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}${ends(word)}`;
    const words = asked.map((word) => new RegExp(pattern(word), "iu"));
    const phrase = new RegExp(asked.map(pattern).join("[^\\p{L}\\p{N}]+"), "iu");
    const is_short = asked.join("").length < 2;
    const pages = is_short ? [] : TEXTS.toSorted((a, b) => (b[0] === here) - (a[0] === here));
    const places = pages.flatMap(([page, name, pieces]) => pieces.flatMap(([id, section, text]) => {
      if (!words.every((word) => word.test(text))) return [];
      const whole = phrase.exec(text);
      const { index: at, 0: match } = whole ?? words[0].exec(text);
      const end = at + match.length;
      const before = text.slice(Math.max(0, at - CONTEXT), at).replace(at > CONTEXT ? /^\S*\s/ : "", "");
      const after = text.slice(end, end + CONTEXT).replace(text.length > end + CONTEXT ? /\s\S*$/ : "", "");
      const where = page === here ? section : `${name}: ${section}`;
      const shown = make("small", {}, before, make("mark", {}, text.slice(at, end)), after);
      // The words of a heading stand in the contents too: its id leads there.
      const words_at = text === section ? "" : `:~:text=${encodeURIComponent(plain(text.slice(at, end + CONTEXT)).replace(/\s\S*$/, "")).replaceAll("-", "%2D")}`;
      return [[`${page}#${id}${words_at}`, where, shown, whole !== null]];
    }));
    // Where the words follow one another comes first.
    places.sort((a, b) => b[3] - a[3]);
    next = 0;
    const lines = places.slice(0, MAX_FINDS).map(([href, where, shown]) => make("li", {}, make("a", { href }, where, make("br"), shown)));
    const more = places.length - MAX_FINDS;
    if (more > 0) lines.push(make("li", {}, make("small", {}, `${more} more: add a word`)));
    if (places.length === 0 && !is_short) lines.push(make("li", {}, make("small", {}, "nothing found")));
    found.replaceChildren(...lines);
  });
  input.addEventListener("keydown", ({ key }) => {
    const finds = all("a", found);
    if (key === "Enter" && finds.length > 0) finds[next++ % finds.length].click();
  });
  if (sections.length > 0) contents.append(make("div", { className: "search", role: "search" }, input, found));

  // What is to be cited is selected and copied; where a page may not copy, it stays selected.
  for (const entry of all(".cite pre")) {
    const copy = make("button", { type: "button" }, "Copy");
    copy.addEventListener("click", async () => {
      getSelection().selectAllChildren(entry);
      const copied = await navigator.clipboard?.writeText(entry.textContent).then(() => true, () => false);
      copy.textContent = copied ? "Copied" : "Selected";
    });
    entry.before(copy);
  }

  // Long cells in a table of many columns can be unfolded; on paper all are open.
  for (const cell of all(".lists td.long")) {
    const start = document.createRange();
    start.setStart(cell, 0);
    const texts = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    let left = 40;
    while (left > 0 && texts.nextNode()) {
      const { data } = texts.currentNode;
      start.setEnd(texts.currentNode, data.slice(left).search(/\s|$/) + Math.min(left, data.length));
      left -= data.length;
    }
    const words = make("span", {}, bare(start.cloneContents()), "\u00a0…");
    const fold = make("details", {}, make("summary", {}, words), ...cell.childNodes);
    cell.replaceChildren(fold);
    // The last column stands below the first words of its row.
    const place = cell.nextElementSibling ? null : cell.parentElement.querySelector(".text");
    place?.append(fold);
    if (place) cell.hidden = true;
  }
  for (const table of all(".lists:has(td.long[hidden])")) table.tHead.rows[0].lastElementChild.hidden = true;
  // A row that a link leads to is open.
  const unfold = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const row = target?.closest("tr");
    for (const fold of row ? all("details", row) : all("details.cite:target")) fold.open = true;
  };
  addEventListener("hashchange", unfold);
  unfold();
  addEventListener("beforeprint", () => all("main details").forEach((fold) => (fold.open = true)));

  // Long tables can be filtered by the columns that have few different words.
  const LONG = 40;
  const FEW = 12;
  for (const table of all("figure.table table")) {
    const lines = all("tbody tr", table);
    if (lines.length < LONG) continue;
    const word = (line, column) => line.cells[column].textContent.trim();
    const choices = all("thead th", table).flatMap((head) => {
      const column = head.cellIndex;
      const words = [...new Set(lines.map((line) => word(line, column)))];
      if (words.length < 2 || words.length > FEW) return [];
      if (head.hidden) return [];
      const options = words.map((text) => make("option", { value: text }, text));
      const select = make("select", {}, make("option", { value: "" }, "all"), ...options);
      return [{ column, select, label: make("label", {}, `${head.textContent.trim()} `, select) }];
    });
    if (choices.length === 0) continue;
    const count = make("output");
    const filter = () => {
      const fits = (line) => choices.every(({ column, select }) => select.value === "" || word(line, column) === select.value);
      lines.forEach((line) => (line.hidden = !fits(line)));
      count.value = `${lines.filter((line) => !line.hidden).length} of ${lines.length}`;
    };
    choices.forEach(({ select }) => select.addEventListener("change", filter));
    // A row that a link leads to is shown.
    addEventListener("hashchange", () => {
      if (document.getElementById(decodeURIComponent(location.hash.slice(1)))?.closest("tr")?.hidden) {
        choices.forEach(({ select }) => (select.value = ""));
        filter();
      }
    });
    filter();
    table.closest("figure").querySelector("figcaption").after(make("div", { className: "filters" }, ...choices.map(({ label }) => label), count));
  }
  mark();
  asked();
}
