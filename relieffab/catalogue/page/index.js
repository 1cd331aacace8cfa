"use strict";
{
  const [search, sort, count, none, cards] =
    ["search", "sort", "count", "none", "cards"].map((id) => document.getElementById(id));
  const all = [...cards.children];
  const plain = (text) => text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase();
  const found = ["h2", ".note", ".facts", ".model"];
  const words = new Map(all.map((card) => [
    card,
    plain(found.flatMap((part) => [...card.querySelectorAll(part)]).map((e) => e.textContent).join(" ")),
  ]));

  const show = () => {
    const asked = plain(search.value).split(/\s+/).filter(Boolean);
    for (const card of all) card.hidden = !asked.every((word) => words.get(card).includes(word));
    const shown = all.filter((card) => !card.hidden).length;
    count.textContent = asked.length ? `${shown} of ${all.length}` : "";
    none.hidden = shown > 0;
  };

  const order = () => {
    const by = sort.value;
    const names = new Intl.Collator(undefined, { numeric: true });
    const way = by === "place" || by === "verdict" ? 1 : -1; // large ones first, bad ones, too
    const compare = (a, b) => by === "name"
      ? names.compare(a.dataset.name, b.dataset.name)
      : way * (a.dataset[by] - b.dataset[by]) || a.dataset.place - b.dataset.place;
    cards.append(...[...all].sort(compare));
  };

  search.addEventListener("input", show);
  sort.addEventListener("change", order);
  search.form.addEventListener("submit", (event) => event.preventDefault());
  show(); // a browser keeps what was typed over a reload
  order();
}
