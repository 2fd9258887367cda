"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const CELL = 5, HEIGHT = 14;
const colours = Object.fromEntries(data.outcomes.map(o => [o.letter, o.colour]));
const names = Object.fromEntries(data.outcomes.map(o => [o.letter, o.name]));

function draw(canvas, row) {
  const cells = data.rows[row].cells;
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, canvas.width, canvas.height);
  for (let i = 0; i < cells.length; i++) {
    if (cells[i] === " ") continue;
    context.fillStyle = colours[cells[i].toLowerCase()];
    context.fillRect(i * CELL, 0, CELL - 1, HEIGHT - 1);
    // A capital letter: some invariant was broken.
    if (cells[i] !== cells[i].toLowerCase()) {
      context.fillStyle = "#c00";
      context.fillRect(i * CELL, 0, CELL - 1, 5);
    }
  }
}

function element(tag, text, parent) {
  const made = document.createElement(tag);
  made.textContent = text;
  parent.append(made);
  return made;
}

function lines(list, story) {
  for (let i = 0; i < story.length; i += 2) {
    element("li", story[i].toFixed(1).padStart(8) + "  " + data.lines[story[i + 1]], list);
  }
}

function show(row, at) {
  const target = document.getElementById("run");
  target.replaceChildren();
  const disturbance = data.rows[row], [version, time, change] = data.instants[at];
  const letter = disturbance.cells[at], token = disturbance.tokens[at] || "";
  if (letter === undefined || letter === " ") return;
  element("h2", `${disturbance.title} ${token}, after version ${version} (${time.toFixed(1)} s: ${change})`, target);
  element("p", `The run ended: ${names[letter.toLowerCase()]}.`, target);
  for (const text of disturbance.broken[at] || []) element("p", "Broken: " + text, target);
  const list = element("ol", "", target);
  const before = data.undisturbed.filter((_, i) => data.undisturbed[i - i % 2] <= time).slice(-12);
  lines(list, before);
  element("li", "", list).append(Object.assign(document.createElement("b"),
    { textContent: time.toFixed(1).padStart(8) + "  — " + disturbance.title + " " + token }));
  const story = disturbance.stories[at] || [];
  lines(list, story);
  if (disturbance.cut[at]) element("li", "…", list).className = "cut";
  element("p", "The whole story: save this as x.toml and run “pelea run " + data.mission +
    " --speed max --scenario x.toml --seed " + data.seed + "”.", target);
  element("pre", disturbance.scenario.replaceAll("@TOKEN@", token).replaceAll("@VERSION@", version).replaceAll("@TIME@", time), target);
  location.hash = row + "," + at;
}

document.querySelectorAll("canvas").forEach((canvas, row) => {
  canvas.width = data.instants.length * CELL;
  canvas.height = HEIGHT;
  draw(canvas, row);
  const where = event => Math.floor(event.offsetX / CELL);
  canvas.addEventListener("click", event => show(row, where(event)));
  canvas.addEventListener("mousemove", event => {
    const instant = data.instants[where(event)];
    const letter = data.rows[row].cells[where(event)];
    canvas.title = instant && letter ? `${instant[1].toFixed(1)} s, ${instant[2]}: ${names[letter.toLowerCase()]}` : "";
  });
});
if (location.hash) show(...location.hash.slice(1).split(",").map(Number));
