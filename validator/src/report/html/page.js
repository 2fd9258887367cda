"use strict";
const ROW = 22;
// Only what is in view is drawn, so that a plan may be long.
function view(box, count, draw) {
  const space = document.createElement("div");
  space.style.height = count * ROW + "px";
  box.append(space);
  const redraw = () => {
    const first = Math.max(0, Math.floor(box.scrollTop / ROW) - 5);
    draw(space, first, Math.min(count, first + Math.ceil(box.clientHeight / ROW) + 10));
  };
  box.addEventListener("scroll", redraw);
  redraw();
  return redraw;
}
function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text !== undefined) made.textContent = text;
  return made;
}
for (const section of document.querySelectorAll("section[data-plan]")) {
  const plan = JSON.parse(section.querySelector("script").textContent);
  const happenings = plan.happenings;
  const [gantt, list, state] = ["gantt", "happenings", "state"].map(c => section.querySelector("." + c));
  if (!gantt) continue;
  let chosen = happenings.length - 1;
  const end = Math.max(1e-9, ...[plan.steps.reduce((most, s) => Math.max(most, s.end), 0)]);
  const label = 300, width = Math.max(200, gantt.clientWidth - label - 30);
  gantt.style.height = Math.min(24 * 16, plan.steps.length * ROW + 4) + "px";
  view(gantt, plan.steps.length, (space, first, last) => {
    const svg = element("svg", { width: label + width + 10, height: (last - first) * ROW });
    svg.style.cssText = "position:absolute;left:0;top:" + first * ROW + "px";
    for (let i = first; i < last; i++) {
      const step = plan.steps[i], fails = plan.fails === i + 1, y = (i - first) * ROW;
      const name = i + 1 + " " + step.text, css = fails ? "fails" : "";
      svg.append(element("text", { x: 6, y: y + 15, class: css }, name.length > 38 ? name.slice(0, 37) + "…" : name));
      const bar = element("rect", { x: label + step.start / end * width, y: y + 4, rx: 2, height: ROW - 8, class: css,
        width: Math.max(3, (step.end - step.start) / end * width) });
      bar.append(element("title", {}, name + " " + step.start + " – " + step.end + (fails ? " — " + plan.why : "")));
      bar.onclick = () => choose(happenings.findIndex(h => h.steps.includes(i + 1)));
      svg.append(bar);
    }
    space.replaceChildren(svg);
  });
  const rows = plan.watched.flatMap(w => w.conditions.map(([condition, stretches], i) => ({ w, condition, stretches, first: i === 0 })));
  const watched = section.querySelector(".watched");
  if (watched) {
    // A state without an end lasts beyond the plan; in time or steps as the plan is.
    const last = Math.max(end, ...plan.watched.map(w => w.at || 0));
    watched.style.height = Math.min(16 * ROW, rows.length * ROW + 4) + "px";
    view(watched, rows.length, (space, first, to) => {
      const svg = element("svg", { width: label + width + 10, height: (to - first) * ROW });
      svg.style.cssText = "position:absolute;left:0;top:" + first * ROW + "px";
      for (let i = first; i < to; i++) {
        const { w, condition, stretches } = rows[i], y = (i - first) * ROW, css = w.broken ? "fails" : "";
        const name = rows[i].first ? (w.broken ? "✗ " : "✓ ") + w.text : "   " + condition;
        const text = element("text", { x: 6, y: y + 15, class: css }, name.length > 38 ? name.slice(0, 37) + "…" : name);
        text.append(element("title", {}, w.text + (w.soft ? " (preference)" : "") + (w.broken ? " is broken" : " is satisfied")));
        svg.append(text);
        svg.append(element("line", { x1: label, x2: label + width, y1: y + ROW / 2, y2: y + ROW / 2, class: "axis" }));
        for (const [from, until] of stretches) {
          if (from > last) continue;
          const to = Math.min(until === null ? last : until, last);
          const bar = element("rect", { x: label + from / last * width, y: y + 6, rx: 2, height: ROW - 12, class: "holds",
            width: Math.max(3, (to - from) / last * width) });
          bar.append(element("title", {}, condition + " holds from " + from + (until === null ? " on" : " until " + until)));
          svg.append(bar);
        }
        if (w.at !== null) {
          const mark = element("rect", { x: label + w.at / last * width - 1, y: y + 2, width: 3, height: ROW - 4, class: "fails" });
          mark.append(element("title", {}, "broken at " + w.at));
          svg.append(mark);
        }
      }
      space.replaceChildren(svg);
    });
  }
  const redraw = view(list, happenings.length, (space, first, last) => {
    space.replaceChildren();
    for (let i = first; i < last; i++) {
      const h = happenings[i], row = document.createElement("div");
      row.className = "row" + (i === chosen ? " now" : "");
      row.style.top = i * ROW + "px";
      row.textContent = h.what + "  " + [...h.deleted.map(a => "−" + a), ...h.added.map(a => "+" + a)].join(" ");
      row.title = row.textContent;
      row.onclick = () => choose(i);
      space.append(row);
    }
  });
  function choose(index) {
    if (index < 0) return;
    chosen = index;
    redraw();
    // The state is what there was in the beginning and all changes since.
    const atoms = new Set(plan.initial.added), fluents = new Map(plan.initial.fluents);
    for (let i = 0; i < index; i++) {
      happenings[i].deleted.forEach(a => atoms.delete(a));
      happenings[i].added.forEach(a => atoms.add(a));
      happenings[i].fluents.forEach(([f, v]) => fluents.set(f, v));
    }
    const h = happenings[index] || { deleted: [], added: [], fluents: [] };
    const lines = [];
    h.deleted.forEach(a => { atoms.delete(a); lines.push(["del", a]); });
    h.added.forEach(a => { atoms.delete(a); lines.push(["add", "+ " + a]); });
    h.fluents.forEach(([f, v]) => { lines.push(["num", f + ": " + fluents.get(f) + " → " + v]); fluents.delete(f); });
    [...fluents].sort().forEach(([f, v]) => lines.push(["", f + ": " + v]));
    [...atoms].sort().forEach(a => lines.push(["", a]));
    state.replaceChildren(...lines.slice(0, 2000).map(([css, text]) => {
      const line = document.createElement("div");
      line.className = css;
      line.textContent = text;
      return line;
    }));
    if (lines.length > 2000) state.append("… and " + (lines.length - 2000) + " more");
  }
  list.style.height = "20rem";
  state.style.height = "20rem";
  redraw();
  choose(Math.max(0, chosen));
  if (plan.fails) gantt.scrollTop = Math.max(0, (plan.fails - 5) * ROW);
  if (chosen > 0) list.scrollTop = chosen * ROW;
}
