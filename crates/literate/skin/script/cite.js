// What is to be cited is selected and copied; where a page may not copy, it stays selected.
for (const entry of all(".cite pre")) {
  const copy = make("button", { type: "button" }, "Copy");
  copy.addEventListener("click", async () => {
    getSelection().selectAllChildren(entry);
    const copied = await navigator.clipboard?.writeText(entry.textContent).then(() => true, () => false);
    entry.scrollIntoView({ block: "nearest" });
    copy.textContent = copied ? "Copied" : "Selected";
  });
  entry.before(copy);
}

