// Long tables can be filtered by the columns that have few different words.
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

