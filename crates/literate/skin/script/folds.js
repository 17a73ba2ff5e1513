// Long cells in a table of many columns can be unfolded; on paper all are open.
for (const cell of all(".lists td.long")) {
  const start = document.createRange();
  start.setStart(cell, 0);
  const texts = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
  let left = 26;
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
// On a phone the rows of a table that is longer than some screens show their keys, and open, if
// these tell them apart.
const SCREENS = 3;
const shut = (row, is_shut) => {
  row.classList.toggle("shut", is_shut);
  row.cells[0].querySelector(".turn").setAttribute("aria-expanded", !is_shut);
};
for (const table of phone.matches ? all(".lists") : []) {
  const rows = all("tbody tr", table);
  const keys = new Set(rows.map((row) => row.cells[0].textContent));
  if (keys.size < rows.length || rows.length >= LONG || table.offsetHeight < SCREENS * innerHeight) continue;
  for (const row of rows) {
    const [key] = row.cells;
    key.prepend(make("button", { type: "button", className: "turn", ariaLabel: `Details of ${key.textContent}` }));
    key.addEventListener("click", ({ target }) => target.closest("a, .value") || shut(row, !row.classList.contains("shut")));
    shut(row, true);
  }
}
// A row that a link leads to is open.
const unfold = () => {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const row = target?.closest("tr");
  if (row?.classList.contains("shut")) shut(row, false);
  for (const fold of row ? all("details", row) : all("details.cite:target")) fold.open = true;
};
addEventListener("hashchange", unfold);
unfold();
addEventListener("beforeprint", () => all("main details").forEach((fold) => (fold.open = true)));

