// Links that leave the folder of the pages, as those to code do, lead somewhere only where its
// project is around it. In a copy of the folder they are words.
let is_copy = false;
const unlink = (within) => all("a[href^='../']", within).forEach((link) => link.replaceWith(...link.childNodes));
const [outside] = all("footer a[href^='../']");
const seen_alone = () => {
  is_copy = true;
  unlink(document.body);
  document.querySelector(".imprint").append(" This folder is a copy without its project, whose files are named and not linked.");
};
if (outside && location.protocol === "file:") {
  document.head.append(make("link", { rel: "prefetch", href: outside.getAttribute("href"), onerror: seen_alone }));
}

