/* The planning tree: boxes laid out from left to right, or as an outline where that has no room. */
(function () {
  const host = document.getElementById("tree");
  if (!host) return;
  const panel = document.getElementById("node"), toggle = document.getElementById("removed");
  const byId = new Map(data.nodes.map(node => [node.id, node]));
  const children = new Map(data.nodes.map(node => [node.id, []]));
  const tops = [];
  for (const node of data.nodes) (node.parent === null ? tops : children.get(node.parent)).push(node);
  const inPlan = new Set(data.plan);
  const THUMBS_UP_TO = 30;
  let boxes = new Map(), order = [], chosen = null;

  const visible = node => node.status !== "removed" || (toggle && toggle.checked);
  const trail = node => { const path = []; for (let at = node; at; at = byId.get(at.parent)) path.unshift(at); return path; };

  function layout() {
    const shown = [];
    const count = data.nodes.filter(visible).length;
    const pictured = count <= THUMBS_UP_TO && Object.keys(pictures).length > 0;
    // Columns as wide as they look well, down to where a name still fits; deeper trees become an outline.
    const columns = Math.max(1, ...data.nodes.filter(visible).map(n => trail(n).length));
    const left = 72, room = Math.floor((host.clientWidth - left - 14) / columns);
    const outline = room < (pictured ? 108 : 176);
    const thumbs = pictured && !outline;
    const across = outline ? Math.max(1, Math.min(18, (host.clientWidth - 176) / columns)) : Math.min(room, thumbs ? 216 : 248), width = Math.round(across - Math.max(12, across * 0.14));
    const small = thumbs && width < 150, shade = Math.round(width / 1.6);
    const height = thumbs ? shade + (small ? 72 : 62) : 50, down = outline ? 58 : height + 16;
    let row = 0;
    const place = new Map(), stack = [];
    // Rows are given out depth first; a parent stands level with the middle of its children.
    (function visit(nodes, depth) {
      for (const node of nodes) {
        if (!visible(node)) continue;
        shown.push(node);
        const below = children.get(node.id).filter(visible);
        if (outline) { place.set(node.id, [depth, row++]); visit(below, depth + 1); continue; }
        if (!below.length) { place.set(node.id, [depth, row++]); continue; }
        visit(below, depth + 1);
        const rows = below.map(child => place.get(child.id)[1]);
        place.set(node.id, [depth, (rows[0] + rows[rows.length - 1]) / 2]);
      }
    })(tops, 0);
    const top = 14;
    const spot = node => { const [depth, line] = place.get(node.id); return [(outline ? 10 : left) + depth * across, top + line * down]; };
    const wide = outline ? host.clientWidth - 4 : left + across * columns;
    const tall = top + row * down + 6;
    host.replaceChildren();
    host.style.height = `${tall + 18}px`;
    boxes = new Map(); order = shown;
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("width", wide); svg.setAttribute("height", tall); svg.setAttribute("aria-hidden", "true");
    host.append(svg);
    const middle = shown.length ? (() => { const ys = tops.filter(visible).map(n => spot(n)[1]); return ys.length ? (ys[0] + ys[ys.length - 1]) / 2 + height / 2 : height / 2; })() : 0;
    if (!outline) {
      const start = make("div", { class: "box start", style: `left:10px;top:${middle - 18}px;width:52px;height:36px;padding:0` }, "start");
      host.append(start);
    }
    for (const node of shown) {
      const [x, y] = spot(node);
      const parent = node.parent === null ? null : byId.get(node.parent);
      if (!outline || parent) {
        const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
        if (outline) { const [px, py] = spot(parent); path.setAttribute("d", `M${px + 8} ${py + 46}V${y + 22}H${x}`); }
        else {
          const [px, py] = parent ? [spot(parent)[0] + width, spot(parent)[1] + height / 2] : [62, middle];
          const cy = y + height / 2, bend = (px + x) / 2;
          path.setAttribute("d", `M${px} ${py}C${bend} ${py} ${bend} ${cy} ${x} ${cy}`);
        }
        if (inPlan.has(node.id)) path.setAttribute("class", "plan");
        svg.append(path);
      }
      const note = node.status === "success" ? (node.changes.length ? "✓ " + node.changes.join(", ") : "✓")
        : node.status === "pending" ? "not tried" : node.status === "removed" ? "removed, not tried"
        : (node.status === "unsafe" ? "! " : "✗ ") + (node.kind || node.status).replace("_", " ");
      const box = make("button", {
        type: "button", role: "treeitem", tabindex: "-1", "aria-selected": "false", "aria-level": String(place.get(node.id)[0] + 1),
        class: ["box", thumbs ? "tall" : "", small ? "small" : "", node.status, node.origin, inPlan.has(node.id) ? "plan" : ""].join(" "), title: node.action + (node.cause ? ": " + node.cause : ""),
        style: `left:${x}px;top:${y}px;height:${outline ? 46 : height}px;width:${outline ? Math.min(560, Math.max(150, wide - x - 12)) : width}px`,
        onclick: () => choose(node.id, true),
      });
      if (thumbs) {
        const frame = node.frames[node.frames.length - 1];
        if (frame && frame.key in pictures) box.append(make("img", { alt: "", decoding: "async", src: pictures[frame.key] }));
        else box.append(make("div", { style: `height:${shade - 5}px` }));
      }
      box.append(make("b", {}, node.action + (node.safe ? " (safe place)" : "")), make("span", {}, note));
      boxes.set(node.id, box);
      host.append(box);
    }
    if (chosen !== null) mark(boxes.has(chosen) ? chosen : null);
  }

  function mark(id) {
    for (const [key, box] of boxes) { box.setAttribute("aria-selected", String(key === id)); box.tabIndex = key === id ? 0 : -1; }
    if (id === null && order.length) boxes.get(order[0].id).tabIndex = 0;
  }

  function table(heads, rows) {
    return make("div", { class: "scroll" }, make("table", {}, make("thead", {}, make("tr", {}, ...heads.map(h => make("th", h.num ? { class: "num" } : {}, h.name || h)))),
      make("tbody", {}, ...rows.map(cells => make("tr", {}, ...cells.map((cell, i) => make("td", heads[i].num ? { class: "num" } : {}, cell)))))));
  }

  function choose(id, byHand) {
    const node = byId.get(id);
    if (!node) return;
    if (!boxes.has(id) && toggle) { toggle.checked = true; layout(); }
    chosen = id; mark(id);
    const box = boxes.get(id);
    if (box && byHand) box.scrollIntoView({ block: "nearest", inline: "nearest" });
    const path = trail(node).slice(0, -1).map(n => n.action).join(" › ");
    const parts = [
      make("div", {}, make("span", { class: "chip " + node.status }, data.symbols[node.status] + " " + node.status), " ",
        make("small", {}, node.origin === "priori" ? "proposed from the instruction" : "added by reflecting on a failure")),
      path ? make("p", { class: "trail" }, "after " + path) : make("p", { class: "trail" }, "from the start"),
      make("h3", {}, node.action + (node.safe ? " (a safe place)" : "")),
    ];
    if (node.cause) parts.push(make("p", { class: "cause " + node.status }, make("b", {}, node.kind.replace("_", " ") + ": "), node.cause, node.time === null ? "" : ` (after ${node.time.toFixed(1)} s)`));
    for (const frame of node.frames) {
      if (!(frame.key in pictures)) continue;
      const image = make("img", { alt: frame.caption, src: pictures[frame.key], decoding: "async" });
      parts.push(make("figure", {}, make("button", { type: "button", class: "frame", onclick: () => zoom(frame.key, `${node.action}: ${frame.caption}`) }, image), make("figcaption", {}, frame.caption)));
    }
    if (node.moved.length) parts.push(make("h4", {}, "What changed"), table([{ name: "object" }, { name: "moved", num: 1 }, { name: "was" }, { name: "is" }],
      node.moved.map(m => [m.object, m.moved_m === null ? "" : (100 * m.moved_m).toFixed(1) + " cm", m.before, m.after])));
    if (node.contacts.length) parts.push(make("h4", {}, "Contacts that mattered"), table([{ name: "s", num: 1 }, { name: "between" }, { name: "peak N", num: 1 }, { name: "N s", num: 1 }],
      node.contacts.map(c => [c.time_s.toFixed(2), `${c.first} and ${c.second}`, c.peak_force_n.toFixed(1), c.impulse_ns.toFixed(2)])));
    if (node.words.length) { parts.push(make("h4", {}, "In the model's words")); for (const said of node.words) parts.push(make("p", { class: "words" }, said)); }
    if (node.losses.length) parts.push(make("h4", {}, "Varied worlds lost here"), table([{ name: "world", num: 1 }, { name: "why" }], node.losses.map(l => [String(l.world), l.text])));
    const facts = [];
    if (node.worlds_alive !== null && data.worlds > 1) facts.push(`${node.worlds_alive} of ${data.worlds} worlds still alive`);
    if (node.simulated_s > 0) facts.push(`${node.simulated_s.toFixed(1)} s simulated in ${node.wall_s.toFixed(2)} s`);
    if (facts.length) parts.push(make("p", { class: "facts" }, facts.join(" · ")));
    panel.replaceChildren(...parts);
    panel.scrollTop = 0;
    if (byHand && host.closest(".explore").clientWidth < 900) panel.scrollIntoView({ block: "start" });
  }

  host.addEventListener("keydown", event => {
    const node = byId.get(chosen === null ? order[0].id : chosen), at = order.indexOf(node);
    const next = { ArrowLeft: node.parent === null ? null : byId.get(node.parent), ArrowRight: children.get(node.id).filter(visible)[0],
      ArrowUp: order[at - 1], ArrowDown: order[at + 1], Home: order[0], End: order[order.length - 1] }[event.key];
    if (!next) return;
    event.preventDefault();
    choose(next.id, false);
    boxes.get(next.id).focus();
  });
  for (const button of document.querySelectorAll("button[data-node]"))
    button.addEventListener("click", () => { choose(Number(button.dataset.node), true); panel.scrollIntoView({ block: "nearest" }); });
  if (toggle) toggle.addEventListener("change", layout);
  let before = host.clientWidth;
  addEventListener("resize", () => { if (host.clientWidth !== before) { before = host.clientWidth; layout(); } });
  layout();
  if (data.nodes.length) choose(data.plan.length ? data.plan[data.plan.length - 1] : (data.nodes.find(n => n.cause) || data.nodes[0]).id, false);
})();
