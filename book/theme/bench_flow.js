// The small figure of the ODE analogy: explicit Euler steps of size x for (1.23), its solution (1.30), and the iterates.

const FLOW = {
  eps: { name: "penalty <i>ε</i>", unit: " N/m", from: 0.1, to: 40, value: 4 },
  x: { name: "step size <i>x</i>", unit: "", from: 0.1, to: 6, value: 1 },
};
const UNTIL = 8;

const drawFlow = (svg, eps, size) => {
  const { values } = numbers(EXAMPLE), width = svg.clientWidth, height = svg.clientHeight, all = { ...values, eps };
  const augmented = recursion({ numbers: "f64", plane: "both" }, all), first = augmented(0);
  const share = u => real["contact::penetration"]({ ...all, u }) / first.p;
  const x = t => 30 + t / UNTIL * (width - 40), y = p => height / 2 * (1 - p / 1.25);
  const at = ([t, u]) => [x(t), y(share(u))];
  const dot = (point, attributes) => {
    const [cx, cy] = at(point);
    return draw("circle", { cx, cy, ...attributes });
  };
  const flow = solution({ ...floats(x => x), exp: Math.exp });
  const curve = Array.from({ length: 161 }, (_, i) => i * UNTIL / 160).map(t => [t, flow({ ...all, u: first.u, t })]);
  const step = u => u + size * real["ode::velocity"]({ ...all, u });
  const euler = [];
  for (let [t, u] = [0, first.u]; t <= UNTIL + 1e-9; [t, u] = [t + size, step(u)]) {
    euler.push([t, u]);
    // The drawing ends at 1.25.
    if (Math.abs(share(u)) >= 9) break;
  }
  const iterates = [];
  for (let k = 0, row = first; k <= UNTIL; k += 1, row = augmented(row.next)) iterates.push([k, row.u]);
  svg.replaceChildren(
    path([[30, y(0)], [width - 10, y(0)]], { class: "bench-plane" }),
    ...[[1, "p₀"], [0, "0"], [-1, "−p₀"]].map(([p, text]) => label(20, y(p) + 4, text, { class: "bench-tick bench-end" })),
    ...Array.from({ length: UNTIL }, (_, i) => label(x(i + 1), height - 4, i + 1 < UNTIL ? i + 1 : "t", { class: "bench-tick bench-middle" })),
    path(curve.map(at), { class: "bench-spring" }),
    path(euler.map(at), { class: "bench-iterate bench-thin" }),
    ...euler.map(point => dot(point, { r: 3, class: "bench-dot" })),
    ...iterates.map(point => dot(point, { r: 5.5, class: "bench-ring" })),
  );
  const factor = share(step(first.u)), rate = Math.abs(factor);
  const way = rate > 1 ? "they diverge" : rate === 1 ? "they neither converge nor diverge" : rate ? "they converge" : "one reaches the plane";
  return `Each step multiplies p by ${brief(exactly(factor))}: ${way}${factor < 0 ? ", with alternating sign" : ""}.`;
};

const openFlow = root => {
  root.insertAdjacentHTML("beforeend", `<div class="bench-live">
<svg class="bench-flow" role="img" aria-label="Penetration over time"></svg>
<div class="bench-key">
  ${key('<path class="bench-spring" d="M0 3Q10 11 28 12"/>', "solution (1.30)")}
  ${key('<path class="bench-iterate bench-thin" d="M4 3L24 11"/><circle class="bench-dot" cx="24" cy="11" r="3"/>', "Euler steps")}
  ${key('<circle class="bench-ring" cx="14" cy="7" r="5.5"/>', "augmentations (1.16)")}
</div>
<div class="bench-fields">${Object.entries(FLOW).map(([id, { name, from, to, value }]) => `
  <label for="flow-${id}">${name}</label>
  <input type="range" id="flow-${id}" min="${from}" max="${to}" step="0.1" value="${value}" data-slide="${id}"><output for="flow-${id}"></output>`).join("")}
</div>
<p role="status"></p></div>`);
  root.classList.add("live");
  const find = selector => root.querySelector(selector), svg = find("svg.bench-flow");
  const show = () => {
    const [eps, size] = Object.entries(FLOW).map(([id, { unit }]) => {
      const { value } = find(`#flow-${id}`);
      find(`output[for=flow-${id}]`).textContent = value + unit;
      return Number(value);
    });
    find("[role=status]").textContent = drawFlow(svg, eps, size);
  };
  root.addEventListener("input", show);
  // The book uses arrow keys to turn pages.
  root.addEventListener("keydown", event => event.stopPropagation());
  new ResizeObserver(show).observe(root);
};

// A page, or the print of all pages, can contain this script several times. Texts about a figure stand before it.
for (const text of document.querySelectorAll(".bench-text")) text.hidden = false;
for (const root of document.querySelectorAll(".bench:not(.live)")) {
  (root.dataset.fields === "x" ? openFlow : open)(root);
}
