// User interface of the bench. Its state is the question, that is, the settings, which are stored in the address.

const FIELDS = {
  eps: { sign: "ε", name: "penalty", unit: "N/m", from: -3, to: 20, powers: true },
  c: { sign: "c", name: "stiffness", unit: "N/m", from: -2, to: 6, powers: true },
  m: { sign: "m", name: "mass", unit: "kg", from: -3, to: 3, powers: true },
  g: { sign: "g", name: "gravity", unit: "m/s²", from: -20, to: 20 },
  l: { sign: "l", name: "free length", unit: "m", from: 0, to: 5 },
  H: { sign: "H", name: "height of the support", unit: "m", from: 0, to: 5 },
  lambda: { sign: "λ₀", name: "initial multiplier", unit: "N", from: -50, to: 50 },
};
// Conversion between the position of a slider and a number with few digits.
const written = ({ powers }, x) => (powers ? String(Number((10 ** x).toPrecision(3))) : String(Number(x.toFixed(2))));
const position = ({ powers }, a) => (powers ? log10(a) : nearest(a, 53, -1074));

// An entry of a legend.
const key = (of, name) => `<span><svg viewBox="0 0 28 14" aria-hidden="true">${of}</svg>${name}</span>`;
const live = (fields, isPenalty) => `
<div class="bench-plots">
<div class="bench-views">
  <svg class="bench-system" role="group" aria-label="The system; the plane can be moved">
    <g></g><g class="bench-plane bench-slider" role="slider" tabindex="0" aria-label="height H of the support above the plane" aria-orientation="vertical" aria-valuenow="0"></g>
  </svg>
  <svg class="bench-forces" role="img" aria-label="Contact force over penetration"></svg>
</div>
<div class="bench-buttons bench-fit"><button type="button" data-step="fit">Fit the axes</button></div>
<div class="bench-key">
  ${key('<path class="bench-spring" d="M0 3L28 11"/>', "equilibrium, <i>c p</i> + <i>N</i> = <i>R</i>")}
  ${key('<path class="bench-spring bench-former" d="M0 3L28 11"/>', "before the last change")}
  ${key('<path class="bench-plane bench-corner" d="M0 12H14V0"/>', "contact")}
  ${key('<path class="bench-iterate" stroke-dasharray="7 4" d="M0 12L28 2"/>', isPenalty ? "<i>N</i> = <i>ε p</i>" : "<i>N</i> = <i>λ<sub>k</sub></i> + <i>ε p</i>")}
  ${key('<path class="bench-iterate bench-thin" d="M4 13L20 7H4"/><circle class="bench-dot" cx="20" cy="7" r="3"/>', "the steps")}
</div>
</div>
<p class="bench-verdict" id="bench-verdict" role="status"></p>
<div class="bench-controls">
<div class="bench-buttons">
  <button type="button" data-step="1">Step</button>
  <button type="button" data-step="10">10 steps</button>
  <button type="button" data-step="-1">Back</button>
  <button type="button" data-step="whole">Until λ repeats</button>
  <button type="button" data-step="start">To the start</button>
  <button type="button" data-step="reset">Reset</button>
</div>
<div class="bench-fields">${Object.entries(FIELDS).filter(([key]) => fields.includes(key)).map(([key, { sign, name, unit, from, to }]) => `
  <label for="bench-${key}"><i>${sign}</i> <span>${name}</span></label>
  <input type="range" min="${from}" max="${to}" step="${(to - from) / 1000}" data-slide="${key}" aria-label="${name} ${sign}, by a slider">
  <span><input type="text" id="bench-${key}" aria-label="${name} ${sign}, in ${unit}" size="9" autocomplete="off" autocapitalize="off" spellcheck="false" data-text="${key}" aria-describedby="bench-verdict"> <span class="bench-unit">${unit}</span></span>`).join("")}
  <label for="bench-numbers">number system</label>
  <select id="bench-numbers" data-choice="numbers">
    <option value="f32">f32</option><option value="f64">f64</option><option value="exact">exact fractions</option>
  </select>
  <label for="bench-side">contact</label>
  <select id="bench-side" data-choice="plane">
    <option value="both">bilateral, as printed</option><option value="one">unilateral</option>
  </select>
</div>
</div>
<div class="bench-rate">
<svg class="bench-decay" role="img" aria-label="The penetration at each step, on a logarithmic scale"></svg>
<div class="bench-key">
  ${key('<circle class="bench-dot" cx="14" cy="7" r="3"/>', "|<i>p<sub>k</sub></i>| as computed")}
  ${key('<circle class="bench-ring" cx="14" cy="7" r="5"/>', "exact |<i>p</i>| at the computed <i>u<sub>k</sub></i>")}
  ${key('<path class="bench-faint" stroke-dasharray="4 3" d="M0 2L28 12"/>', "<i>ρ<sup>k</sup></i>|<i>p</i><sub>0</sub>|")}
  ${key('<path class="bench-thin" stroke-dasharray="1 3" d="M0 7H28"/>', "<i>F</i>, scale of the rounding floor")}
</div>
</div>
<div class="bench-table" role="region" aria-label="Values of the steps" tabindex="0"><table>
  <thead><tr><th scope="col"><i>k</i></th><th scope="col"><i>λ<sub>k</sub></i> in N</th><th scope="col"><i>u<sub>k</sub></i> in m</th>
  <th scope="col"><i>p<sub>k</sub></i> in m</th><th scope="col"><i>λ</i><sub><i>k</i>+1</sub> in N</th></tr></thead><tbody></tbody>
</table></div>
<p class="bench-more"></p>`;

const draw = (name, attributes = {}, ...children) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};
const path = (points, attributes) =>
  draw("path", { fill: "none", d: points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join(""), ...attributes });
const label = (x, y, text, attributes = {}) => draw("text", { x, y, ...attributes }, text);

// Clips the line through two points to a box given by two [x, y] corners.
const clipped = ([x0, y0], [x1, y1], [[left, low], [right, high]]) => {
  let [from, to] = [-Infinity, Infinity];
  for (const [at, by, min, max] of [[x0, x1 - x0, left, right], [y0, y1 - y0, low, high]]) {
    const [a, b] = [(min - at) / by, (max - at) / by];
    if (by) [from, to] = [Math.max(from, Math.min(a, b)), Math.min(to, Math.max(a, b))];
    else if (at < min || at > max) return [];
  }
  return from < to ? [from, to].map(t => [x0 + t * (x1 - x0), y0 + t * (y1 - y0)]) : [];
};
const hull = (numbers, more) => {
  const [min, max] = [Math.min(...numbers), Math.max(...numbers)];
  const room = (max - min || 1) * more;
  return [min - room, max + room];
};

const floor = x => 10 ** Math.floor(Math.log10(x));
const { f: real } = systems.f64;
const toFloat = a => nearest(a, 53, -1074);

/* The three drawings. All numbers are converted to f64. */

const seen = run => {
  const number = value => toFloat(run.system.exactly(value));
  const values = Object.fromEntries(Object.entries(run.values).map(([name, value]) => [name, number(value)]));
  const few = Math.ceil(run.rows.length / 80);
  const rows = run.rows.map((row, k) => ({ k, row })).filter(({ k }) => k % few === 0 || k === run.rows.length - 1);
  return {
    values,
    rows: rows.map(({ k, row }) => ({
      k, row, lambda: number(row.lambda), u: number(row.u), p: number(row.p), next: number(row.next),
    })),
  };
};

// The range of lengths that is drawn, with round limits; the last range is kept if it suffices.
const lengths = ({ values, rows }, last = [0, 0]) => {
  const [least, most] = hull([0, values.H, values.l, ...rows.map(({ u }) => values.l + u)], 0);
  if (last[0] <= least && most <= last[1]) return last;
  const far = Math.max(-least, most) * 1.1 || 1, unit = floor(far);
  const limit = [1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find(n => n * unit >= far) * unit;
  return [least < 0 ? -limit : 0, limit];
};

const drawSystem = (svg, { values, rows }, [least, most], question) => {
  const width = svg.clientWidth, height = svg.clientHeight, middle = Math.min(width / 2 - 10, width - 90);
  const y = length => 24 + (length - least) / (most - least) * (height - 48), plane = y(values.H);
  const hatch = (at, by) => Array.from({ length: Math.floor((width - 20) / 10) }, (_, i) => `M${14 + 10 * i} ${at}l-6 ${by}`).join("");
  const parts = [
    draw("path", { d: `M10 ${y(0)}H${width - 10}${hatch(y(0), -7)}`, class: "bench-thin" }),
    path([[10, y(values.l)], [width - 10, y(values.l)]], { class: "bench-faint", "stroke-dasharray": "3 4" }),
    label(width - 10, y(values.l) - 4, "l", { class: "bench-italic bench-end" }),
  ];
  const now = rows.at(-1);
  if (now) {
    const end = y(values.l + now.u), one = question.plane === "one";
    const spring = (top, bottom, turns, attributes) => {
      const coil = Array.from({ length: turns }, (_, i) => [middle + (i % 2 ? 9 : -9), top + (bottom - top) * (i + 1.5) / (turns + 2)]);
      return path([[middle, top], ...coil, [middle, bottom]], attributes);
    };
    parts.push(spring(y(0), end, 12, { class: "bench-spring" }));
    // The second spring stands below the plane; in unilateral contact the mass can leave it.
    const foot = plane + 44, touched = one && now.next <= 0 ? plane : end;
    parts.push(draw("g", { class: "bench-second" },
      spring(touched, foot, 6, { class: "bench-iterate bench-thin" }), path([[middle - 14, foot], [middle + 14, foot]], { class: "bench-thin" }),
      label(middle + 14, (plane + foot) / 2 + 12, "ε", { class: "bench-italic" })));
    // N = λ + ε p, the force on the mass, relative to R.
    const scale = 40 / Math.max(Math.abs(now.next), Math.abs(real["system::reaction"](values))), force = now.next * scale;
    if (Number.isFinite(force) && Math.abs(force) > 1) {
      const [from, tip] = [end + 8 + Math.max(force, 0), end + 8 + Math.max(-force, 0)], at = middle - 28, head = force > 0 ? 6 : -6;
      parts.push(path([[at, from], [at, tip]], { class: "bench-force" }), path([[at - 4, tip + head], [at, tip], [at + 4, tip + head]], { class: "bench-force" }));
      parts.push(label(at - 5, (from + tip) / 2 + 4, "N", { class: "bench-italic bench-end" }));
    }
    // The gap, from the free end of the spring to the plane.
    if (Math.abs(plane - y(values.l)) > 14) {
      parts.push(path([[width - 26, y(values.l)], [width - 26, plane]], { class: "bench-thin" }), label(width - 30, (y(values.l) + plane) / 2 + 4, "gap", { class: "bench-end bench-tick" }));
    }
    parts.push(draw("circle", { cx: middle, cy: end, r: 7, class: "bench-mass" }), label(middle + 12, end - 6, "m", { class: "bench-italic" }));
  }
  const [still, slider] = svg.children;
  still.replaceChildren(...parts);
  const limits = { "aria-valuemin": least, "aria-valuemax": most, "aria-valuenow": values.H, "aria-valuetext": `${question.H} m` };
  for (const [name, value] of Object.entries(limits)) slider.setAttribute(name, value);
  slider.replaceChildren(
    draw("rect", { x: 0, y: plane - 16, width, height: 40, class: "bench-grip" }),
    draw("path", { d: `M10 ${plane}H${width - 10}`, "stroke-width": 2.5 }),
    draw("path", { d: hatch(plane, 7), "stroke-width": 1 }),
    label(width - 10, Math.min(plane + 22, height - 2), `H = ${question.H} m`, { class: "bench-end" }),
  );
  return from => least + (from - 24) / (height - 48) * (most - least);
};

// The box of the force diagram: p from left to right, N from low to high.
const forceBox = ({ values, rows }) => {
  const reaction = real["system::reaction"](values);
  const free = real["contact::penetration"]({ ...values, u: real["structure::deflection"](values) });
  const [left, right] = hull([0, free, ...rows.map(row => row.p)], 0.2);
  const [low, high] = hull([0, reaction, ...rows.flatMap(row => [row.lambda, row.next])], 0.15);
  return [[left, low], [right, high]];
};

// Whether the solution and the steps are in a box.
const shows = ([[left, low], [right, high]], { values, rows }) => {
  const corners = [[0, 0], [0, real["system::reaction"](values)], ...rows.map(({ p, next }) => [p, next])];
  return corners.every(([p, n]) => left <= p && p <= right && low <= n && n <= high);
};

// Whether two lines of equilibrium differ.
const changed = (before, now) => ["c", "m", "g", "l", "H"].some(name => before[name] !== now[name]);

// The smallest box that contains two.
const joined = ([a, b], [c, d]) => [a.map((x, i) => Math.min(x, c[i])), b.map((x, i) => Math.max(x, d[i]))];

// Round numbers with a distance of 1, 2 or 5 times a power of ten, at most `count` between two limits.
const ticks = (from, to, count) => {
  const unit = floor((to - from) / count), step = [1, 2, 5, 10].find(n => n * unit * count >= to - from) * unit;
  const numbers = [];
  for (let n = Math.ceil(from / step); n * step <= to; n += 1) numbers.push(n * step);
  return numbers;
};

// The line of equilibrium at two penetrations, for the values of a question.
const equilibrium = (values, far) => {
  const held = u => [real["contact::penetration"]({ ...values, u }), real["augmented::contact_force"]({ ...values, u })];
  const gap = real["system::gap"](values);
  return [held(gap), held(gap + far)];
};

const drawForces = (svg, { values, rows }, run, box, former = values) => {
  const width = svg.clientWidth, height = svg.clientHeight, one = run.question.plane === "one";
  const gap = real["system::gap"](values), reaction = real["system::reaction"](values);
  const update = real["augmented::update"];
  const p = u => real["contact::penetration"]({ ...values, u });
  const [[left, low], [right, high]] = box;
  if (!box.flat().every(Number.isFinite)) return svg.replaceChildren(label(10, 20, "too large to draw"));
  const at = ([p, n]) => [(p - left) / (right - left) * (width - 2) + 1, (high - n) / (high - low) * (height - 2) + 1];
  const line = (a, b, attributes, within = box) => path(clipped(a, b, within).map(at), attributes);
  const span = right - left, far = gap + span;
  const [x0, y0] = at([0, 0]), [, y1] = at([0, reaction]), force = `R = ${brief(exact["system::reaction"](inFractions(run)))} N`;
  const text = x => brief(exactly(x)), axes = [], texts = [];
  for (const x of ticks(left, right, Math.max(2, Math.floor(width / 90)))) {
    const [at_x] = at([x, 0]);
    axes.push(path([[at_x, height - 16], [at_x, height - 20]], { class: "bench-thin" }));
    if (at_x > 24 && at_x < width - 16) texts.push(label(at_x, height - 4, text(x), { class: "bench-tick bench-middle" }));
  }
  for (const x of ticks(low, high, Math.max(2, Math.floor(height / 50)))) {
    const [, at_y] = at([0, x]);
    if (x && at_y > 26 && at_y < height - 26) texts.push(label(4, at_y + 4, text(x), { class: "bench-tick" }));
  }
  texts.push(
    // Titles stand inside the drawing, on different sides of an axis at its edge.
    label(width - 2, y0 < 40 ? y0 + 18 : y0 - 8, "p in metres", { class: "bench-tick bench-end" }),
    x0 > width - 90 ? label(x0 - 8, 9, "N in newtons", { class: "bench-tick bench-end" }) : label(x0 + 8, 9, "N in newtons", { class: "bench-tick" }),
    // Labels stand clear of the falling line.
    reaction < 0 && x0 > 8 * force.length ? label(x0 - 6, Math.min(y1 + 14, height - 24), force, { class: "bench-end" }) : label(x0 + 8, Math.max(y1 - 4, 24), force),
  );
  const parts = [
    ...axes,
    line([0, 0], [span, 0], { class: "bench-faint" }),
    line([0, 0], [0, 1], { class: "bench-faint" }),
    ...(changed(former, values) ? [line(...equilibrium(former, span), { class: "bench-spring bench-former" })] : []),
    line(...equilibrium(values, span), { class: "bench-spring" }),
    path([at([left, 0]), at([0, 0]), at([0, high])], { class: "bench-plane bench-corner" }),
  ];
  const now = rows.at(-1);
  if (now) {
    const { lambda } = now, above = one ? [[left, Math.max(low, 0)], box[1]] : box;
    parts.push(line([0, lambda], [p(far), update({ ...values, lambda, u: far })], { class: "bench-iterate", "stroke-dasharray": "7 4" }, above));
    // If the positive part vanishes, the path along the line ends at N = 0.
    const bend = ({ lambda, u, p }) => {
      const open = update({ ...values, lambda, u });
      return one && open < 0 && lambda > 0 ? [[p * lambda / (lambda - open), 0]] : [];
    };
    const first = rows.slice(0, 40);
    const way = first.flatMap(row => [[0, row.lambda], ...bend(row), [row.p, row.next], [0, row.next]]);
    parts.push(path(way.map(at), { class: "bench-iterate bench-thin" }));
    for (const row of new Set([...first, now])) {
      const [cx, cy] = at([row.p, row.next]);
      parts.push(draw("circle", { cx, cy, r: row === now ? 5 : 2.5, class: "bench-dot" }));
    }
  }
  // Texts hide the lines behind them.
  svg.replaceChildren(...parts, ...texts);
};

const drawDecay = (svg, { values, rows }, run) => {
  const width = svg.clientWidth, height = svg.clientHeight, left = 50, bottom = height - 26;
  const decades = a => (a.n ? log10(magnitude(a)) : undefined);
  const points = rows.map(({ k, row }) => ({
    k, computed: decades(run.system.exactly(row.p)), exact: decades(penetration(run, row)),
  }));
  const { precision } = run.system, given = inFractions(run);
  const least = precision && exact["system::reaction"](given).n >= 0n
    ? decades(exact["rounding::floor_scale"]({ ...given, n: precision })) : undefined;
  const known = [...points.flatMap(point => [point.computed, point.exact]), least].filter(value => value !== undefined);
  const last = Math.max(10, points.at(-1)?.k ?? 0);
  const high = known.length ? Math.ceil(Math.max(...known) + 0.1) : 0;
  const low = known.length ? Math.min(Math.floor(Math.min(...known) - 0.1), high - 3) : -3;
  const x = k => left + 10 + k / last * (width - left - 24);
  const y = value => (value === undefined ? bottom : 12 + (high - value) / (high - low) * (bottom - 32));
  const level = (value, attributes) => path([[left, y(value)], [width - 4, y(value)]], attributes);
  const parts = [path([[left, 4], [left, bottom], [width - 4, bottom]], { class: "bench-thin" })];
  const every = Math.ceil((high - low) / Math.max(2, Math.floor(bottom / 40)));
  for (let tick = high; tick >= low; tick -= every) {
    parts.push(level(tick, { class: "bench-faint" }), label(left - 6, y(tick) + 4, `10${raised(tick)}`, { class: "bench-end" }));
  }
  parts.push(
    label(left - 6, bottom + 4, "0", { class: "bench-end" }),
    label(left + 7, height - 8, "0"), label(width - 4, height - 8, `k = ${last}`, { class: "bench-end" }),
  );
  const rho = Math.log10(real["augmented::contraction"](values)), start = points[0]?.exact;
  // The law ρᵏ holds as long as the contact is active.
  if (start !== undefined && Number.isFinite(rho) && (run.question.plane === "both" || exact["system::reaction"](given).n >= 0n)) {
    const ends = clipped([0, start], [last, start + last * rho], [[0, low], [last, high]]);
    parts.push(path(ends.map(([k, value]) => [x(k), y(value)]), { class: "bench-faint", "stroke-dasharray": "4 3" }));
  }
  if (least !== undefined) {
    parts.push(level(least, { class: "bench-thin", "stroke-dasharray": "1 3" }), label(width - 4, y(least) - 4, "F", { class: "bench-italic bench-end" }));
  }
  for (const point of points) {
    parts.push(draw("circle", { cx: x(point.k), cy: y(point.exact), r: 5, class: "bench-ring" }));
    parts.push(draw("circle", { cx: x(point.k), cy: y(point.computed), r: 2.5, class: "bench-dot" }));
  }
  svg.replaceChildren(...parts);
};

/* The interactive page. */

const SHOWN = 12;

// The result of a small figure: the state of the solution, or that of the penalty method.
const summary = (result, solved) => {
  const given = inFractions(result), { rows, system } = result;
  const reaction = exact["system::reaction"](given), text = (a, unit) => `${brief(a)} ${unit}`;
  if (!solved) {
    const { p, next } = rows.at(-1), force = system.exactly(next);
    const short = reaction.n > 0n ? `, short of R by ${text(fractions.sub(reaction, force), "N")}` : "";
    return { kind: "penalty", text: `p = ${text(system.exactly(p), "m")} and N = ⟨ε p⟩ = ${text(force, "N")}${short}.` };
  }
  const p = exact["contact::penetration"]({ ...given, u: exact["contact::deflection"](given) });
  const kind = reaction.n > 0n ? "contact" : reaction.n ? "separated" : "grazing";
  return { kind, text: `R = ${text(reaction, "N")}, so p = ${text(p, "m")} and N = ${text(exact["contact::contact_force"](given), "N")}.` };
};

// A root with `data-fields` is a small figure with these fields alone, whose state is not in the address.
const open = root => {
  const small = root.dataset.fields !== undefined, fields = small ? root.dataset.fields.split(" ") : Object.keys(FIELDS);
  root.insertAdjacentHTML("beforeend", `<div class="bench-live">${live(fields, root.dataset.k === "0")}</div>`);
  root.classList.add("live");
  const find = selector => root.querySelector(selector);
  const initial = small ? { ...EXAMPLE, numbers: "exact", k: Number(root.dataset.k) } : EXAMPLE;
  let question = small ? initial : asked(location.search), result, view, domain, box, former, settled, length, held, width;

  const fill = () => {
    for (const key of fields) {
      const text = find(`[data-text=${key}]`), slide = find(`[data-slide=${key}]`);
      if (text !== document.activeElement || text.value !== question[key]) text.value = question[key];
      slide.setAttribute("aria-valuetext", `${question[key]} ${FIELDS[key].unit}`);
    }
    for (const choice of root.querySelectorAll("[data-choice]")) choice.value = question[choice.dataset.choice];
  };
  const paint = () => {
    if (!result) return;
    view = seen(result);
    // The axes stay until the solution leaves them; while the pointer is down they only grow.
    domain = lengths(view, domain);
    if (!box || !shows(box, view)) box = held && box ? joined(box, forceBox(view)) : forceBox(view);
    settled ??= view.values;
    if (!domain.every(Number.isFinite)) return;
    length = drawSystem(find(".bench-system"), view, domain, question);
    drawForces(find(".bench-forces"), view, result, box, changed(settled, view.values) ? settled : former);
    drawDecay(find(".bench-decay"), view, result);
  };
  // Prevents line breaks before a unit and in a sum.
  const whole = text => text.replace(/ (?=[Nm%][ ,.;)])| (?=[+−] )|(?<=[+−]) /g, "\u00a0");
  const say = (kind, text) => {
    const output = find(".bench-verdict"), rest = whole(text);
    if (output.textContent === kind + rest) return;
    output.replaceChildren(Object.assign(document.createElement("b"), { textContent: kind }), rest);
  };

  const show = (untilRest = false) => {
    const { values, wrong } = numbers(question), mistakes = Object.entries(wrong);
    fill();
    for (const key of fields) find(`[data-text=${key}]`).setAttribute("aria-invalid", key in wrong);
    if (mistakes.length) return say("", mistakes.map(([key, why]) => `${FIELDS[key].sign}: ${why}.`).join(" "));
    for (const key of fields) {
      const slide = find(`[data-slide=${key}]`);
      if (slide !== document.activeElement) slide.value = position(FIELDS[key], systems[question.numbers].exactly(values[key]));
    }
    result = run(question, values, untilRest);
    const { rows, system } = result, k = rows.length - 1;
    const { kind, text } = small && rows.length ? summary(result, root.classList.contains("bench-solved")) : verdict(result);
    if (untilRest) question = { ...question, k: Math.max(k, 0) };
    say(kind, `${small || k < 0 ? "" : `, k = ${k}`}. ${text}`);
    find(".bench-table tbody").replaceChildren(...rows.slice(-SHOWN).map((row, i) => {
      const line = document.createElement("tr");
      const cells = [Math.max(0, rows.length - SHOWN) + i, ...[row.lambda, row.u, row.p, row.next].map(system.show)];
      line.append(...cells.map(cell => Object.assign(document.createElement("td"), { textContent: cell })));
      return line;
    }));
    find(".bench-more").textContent = rows.length > SHOWN ? `The last ${SHOWN} of ${rows.length} steps.` : "";
    paint();
  };
  // Ends a change: the line before it stays as the former one.
  const keep = () => {
    if (view && changed(settled, view.values)) [former, settled] = [settled, view.values];
    if (small) return;
    try { history.replaceState(null, "", `${location.pathname}${address(question)}#bench`); } catch { /* the address may be fixed */ }
  };
  const change = (changes, untilRest) => {
    question = { ...question, ...changes };
    show(untilRest);
  };

  root.addEventListener("input", ({ target }) => {
    const { slide, text, choice } = target.dataset;
    if (slide) change({ [slide]: written(FIELDS[slide], Number(target.value)) });
    if (text) change({ [text]: target.value });
    if (choice) change({ [choice]: target.value });
  });
  root.addEventListener("change", keep);
  root.addEventListener("click", ({ target }) => {
    const { step } = target.dataset;
    if (!step) return;
    if (["fit", "reset"].includes(step)) domain = box = former = settled = undefined;
    if (step === "whole") change({}, true);
    else if (step === "fit") change({});
    else if (step === "reset") change(initial);
    else change({ k: step === "start" ? 0 : Math.max(0, (result?.rows.length ?? 1) - 1 + Number(step)) });
    keep();
  });

  // Moves the plane, by arrow keys or by dragging.
  let dragged = false;
  const move = height => {
    const digits = Math.max(0, 2 - Math.floor(Math.log10(domain[1] - domain[0])));
    const within = Math.min(Math.max(height, domain[0]), domain[1]);
    change({ H: String(Number(within.toFixed(Math.min(digits, 20)))) });
  };
  root.addEventListener("keydown", event => {
    // The book uses arrow keys to turn pages, and a letter to search.
    event.stopPropagation();
    if (!view || event.target.getAttribute("role") !== "slider") return;
    const unit = floor(domain[1] - domain[0]) / 100, { H } = view.values;
    const to = {
      ArrowUp: H - unit, ArrowLeft: H - unit, ArrowDown: H + unit, ArrowRight: H + unit,
      PageUp: H - 10 * unit, PageDown: H + 10 * unit, Home: domain[0], End: domain[1],
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    move(to);
    keep();
  });
  const system = find(".bench-system");
  const drag = event => move(length(event.clientY - system.getBoundingClientRect().top));
  system.addEventListener("pointerdown", event => {
    if (!view || !event.target.closest("[role=slider]")) return;
    event.preventDefault();
    system.setPointerCapture(event.pointerId);
    find("[role=slider]").focus({ preventScroll: true });
    [dragged, held] = [true, question];
  });
  system.addEventListener("pointermove", event => dragged && drag(event));
  // A finger on the plane moves it, and elsewhere scrolls the page; `touch-action` has no effect inside an SVG.
  system.addEventListener("touchstart", event => {
    if (event.target.closest("[role=slider]")) event.preventDefault();
  }, { passive: false });
  root.addEventListener("pointerdown", ({ target }) => {
    if (target.dataset.slide) held = question;
  });
  for (const end of ["pointerup", "pointercancel"]) {
    addEventListener(end, () => {
      if (!held) return;
      // A finger that scrolls the page has moved the slider that it touched.
      if (end === "pointercancel" && !dragged) {
        document.activeElement?.blur?.();
        change(held);
      }
      [dragged, held] = [false, undefined];
      keep();
    });
  }

  new ResizeObserver(() => {
    if (root.clientWidth === width) return;
    width = root.clientWidth;
    paint();
  }).observe(root);
  show();
  if (small) return;

  // Links on this page that change the settings do not reload the page.
  const again = () => {
    question = asked(location.search);
    domain = box = former = settled = undefined;
    show();
  };
  addEventListener("popstate", again);
  document.addEventListener("click", event => {
    const link = event.target.closest?.("a[href$='#bench']");
    if (!link || link.pathname !== location.pathname || !link.search) return;
    if (event.ctrlKey || event.metaKey || event.shiftKey || event.button) return;
    try { history.pushState(null, "", link.href); } catch { return; }
    event.preventDefault();
    again();
    document.getElementById("bench")?.scrollIntoView();
  });
};
