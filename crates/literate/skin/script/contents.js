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

