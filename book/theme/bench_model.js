// Runs of the recursion. The formulas are those of `formulas`, which is generated; this file has the number systems,
// the parsing of the input, and the analysis of a run.

/* Fractions: { n, d } in lowest terms, d > 0. */

const size = n => (n < 0n ? -n : n);
const divisor = (a, b) => {
  while (b) [a, b] = [b, a % b];
  return size(a);
};
const fraction = (n, d = 1n) => {
  const g = d < 0n ? -divisor(n, d) : divisor(n, d);
  return { n: n / g, d: d / g };
};
const same = (a, b) => a.n === b.n && a.d === b.d;

// Common divisors are taken out of small numbers first: of two long denominators one often divides the other.
const sum = (a, b) => {
  const g = divisor(a.d, b.d);
  const n = a.n * (b.d / g) + b.n * (a.d / g);
  const h = divisor(n, g);
  return { n: n / h, d: (a.d / g) * (b.d / h) };
};
const product = (a, b) => {
  const g = divisor(a.n, b.d), h = divisor(b.n, a.d);
  return { n: (a.n / g) * (b.n / h), d: (a.d / h) * (b.d / g) };
};
const inverse = ({ n, d }) => {
  if (!n) throw RangeError("division by zero");
  return n < 0n ? { n: -d, d: -n } : { n: d, d: n };
};
const minus = a => ({ n: -a.n, d: a.d });
const below = (a, b) => a.n * b.d < b.n * a.d;
const zero = { n: 0n, d: 1n };
const magnitude = a => ({ n: size(a.n), d: a.d });

/* Arithmetic of the formulas. */

const fractions = {
  int: n => ({ n: BigInt(n), d: 1n }),
  neg: minus,
  add: sum,
  sub: (a, b) => sum(a, minus(b)),
  mul: product,
  div: (a, b) => product(a, inverse(b)),
  positivePart: a => (a.n > 0n ? a : zero),
  min: (a, b) => (below(b, a) ? b : a),
};

// Comparisons agree with engine/src/number: ⟨−0⟩ is 0, and the minimum of equal numbers is the first. Rounding the
// f64 result of two f32 operands is a single rounding, since 53 ≥ 2·24 + 2.
const floats = round => ({
  int: n => round(n),
  neg: a => -a,
  add: (a, b) => round(a + b),
  sub: (a, b) => round(a - b),
  mul: (a, b) => round(a * b),
  div: (a, b) => round(a / b),
  positivePart: a => (a > 0 ? a : 0),
  min: (a, b) => (b < a ? b : a),
});

/* Between fractions, floats and texts. */

const bits = n => {
  const digits = size(n).toString(16);
  return n ? digits.length * 4 - Math.clz32(parseInt(digits[0], 16)) + 28 : 0;
};

// A finite f64 as a fraction.
const exactly = x => {
  const [word] = new BigUint64Array(Float64Array.of(x).buffer);
  const exponent = Number((word >> 52n) & 2047n), digits = word & (2n ** 52n - 1n);
  const n = exponent ? digits + 2n ** 52n : digits, shift = BigInt(Math.max(exponent, 1) - 1075);
  const a = shift < 0n ? fraction(n, 1n << -shift) : fraction(n << shift);
  return word >> 63n ? minus(a) : a;
};

// Rounds to `precision` bits, ties to even; `lowest` is the exponent of the smallest subnormal.
const nearest = (a, precision, lowest) => {
  const over = exponent => (exponent < 0 ? size(a.n) << BigInt(-exponent) : size(a.n));
  const under = exponent => (exponent < 0 ? a.d : a.d << BigInt(exponent));
  const lead = bits(a.n) - bits(a.d);
  const exponent = Math.max(lead - precision + (over(lead) < under(lead) ? 0 : 1), lowest);
  const q = over(exponent) / under(exponent), twice = 2n * (over(exponent) % under(exponent));
  const up = twice > under(exponent) || (twice === under(exponent) && q % 2n === 1n);
  // In two parts, since 2 to the exponent may overflow or underflow.
  const half = Math.trunc(exponent / 2);
  return (a.n < 0n ? -1 : 1) * Number(up ? q + 1n : q) * 2 ** half * 2 ** (exponent - half);
};

// log₁₀ of a positive fraction, which may be out of the range of floats.
const log10 = ({ n, d }) => {
  const log2 = n => {
    const shift = Math.max(bits(n) - 53, 0);
    return Math.log2(Number(n >> BigInt(shift))) + shift;
  };
  return (log2(n) - log2(d)) * Math.LOG10E * Math.LN2;
};

const LONGEST = 40, LARGEST = 400;

// Parses a decimal, with an optional exponent, or a fraction exactly.
const parse = text => {
  const plain = text.trim().replace(/[\u2212\u2010-\u2015\uFE63\uFF0D]/g, "-");
  const ratio = /^([+-]?\d+)\/(\d+)$/.exec(plain);
  const decimal = /^([+-]?)(\d*)\.?(\d*)(?:[eE]([+-]?\d+))?$/.exec(plain);
  if (plain.length > LONGEST) throw RangeError(`more than ${LONGEST} characters`);
  if (ratio) {
    if (!BigInt(ratio[2])) throw RangeError("division by zero");
    return fraction(BigInt(ratio[1]), BigInt(ratio[2]));
  }
  if (!decimal || !(decimal[2] + decimal[3])) throw RangeError("not a number such as 0.05, 5e-2 or 1/20");
  const [, sign, whole, part, power = "0"] = decimal;
  if (Math.abs(Number(power)) > LARGEST) throw RangeError(`an exponent beyond ±${LARGEST}`);
  const shift = Number(power) - part.length;
  const digits = BigInt(whole + part) * (sign === "-" ? -1n : 1n);
  return shift < 0 ? fraction(digits, 10n ** BigInt(-shift)) : fraction(digits * 10n ** BigInt(shift));
};

const raised = n => String(n).replace(/./g, c => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));

// Formats a fraction, rounded to `digits` digits: 0.0481, 4.1·10⁻¹⁷.
const brief = (a, digits = 3) => {
  if (!a.n) return "0";
  const times = power => (power < 0 ? fraction(1n, 10n ** BigInt(-power)) : fraction(10n ** BigInt(power)));
  const rounded = power => {
    const { n, d } = product(magnitude(a), times(power));
    return String((2n * n + d) / (2n * d));
  };
  // Rounding of the logarithm or of the number may change the number of digits by one.
  const guess = Math.floor(log10(magnitude(a)));
  const exponent = guess + rounded(digits - 1 - guess).length - digits;
  const text = rounded(digits - 1 - exponent).replace(/0+$/, ""), sign = a.n < 0n ? "−" : "";
  const point = (whole, part) => sign + whole + (part && `.${part}`);
  if (exponent >= 6 || exponent < -4) return `${point(text[0], text.slice(1))}·10${raised(exponent)}`;
  if (exponent < 0) return point("0", "0".repeat(-exponent - 1) + text);
  return point(text.slice(0, exponent + 1).padEnd(exponent + 1, "0"), text.slice(exponent + 1));
};

// Formats a ratio in percent, unless it is small.
const share = a => (below(a, { n: 1n, d: 1000n }) ? brief(a) : `${brief(product(a, { n: 100n, d: 1n }))} %`);

/* The number systems. */

const machine = (name, precision, lowest, round) => {
  const read = a => {
    const x = nearest(a, precision, lowest);
    if (!Number.isFinite(round(x))) throw RangeError(`too large for ${name}`);
    if (a.n && !x) throw RangeError(`not zero, but rounded to zero in ${name}`);
    return x;
  };
  // The result after an intermediate overflow may look normal.
  const strictly = x => {
    if (!Number.isFinite(round(x))) throw RangeError(`too large for ${name}`);
    return round(x);
  };
  // Formats a float as the shortest decimal that is parsed as the same float.
  const show = x => {
    for (let digits = 1; digits < 17; digits += 1) {
      const text = String(Number(x.toPrecision(digits)));
      if (round(Number(text)) === x) return text;
    }
    return String(x);
  };
  return {
    name, read, exactly, show, same: Object.is, most: 10000,
    precision: fraction(2n ** BigInt(precision)), f: formulas(floats(round)), strict: formulas(floats(strictly)),
  };
};
const systems = {
  f32: machine("f32", 24, -149, Math.fround),
  f64: machine("f64", 53, -1074, x => x),
  exact: {
    name: "exact", read: a => a, exactly: a => a, same, most: 200,
    show: a => (`${a.n}/${a.d}`.length > 24 ? `≈ ${brief(a, 12)}` : a.d === 1n ? `${a.n}` : `${a.n}/${a.d}`),
    f: formulas(fractions), strict: formulas(fractions),
  },
};

/* The settings: the parameters as texts, the number of steps, the number system, and the kind of contact. */

const PARAMETERS = ["c", "m", "g", "l", "H", "eps", "lambda"];
const START = {
  c: "100", m: "1", g: "9.81", l: "1", H: "1.05", eps: "100", lambda: "0", k: 4, numbers: "f64", plane: "both",
};

// The example of the page, shown without a query.
const EXAMPLE = { ...START, c: "4", g: "10", H: "3", eps: "4", k: 3, plane: "one" };

// Parses the query of an address; missing settings have their initial values.
const asked = query => {
  if (!query) return { ...EXAMPLE };
  const given = new URLSearchParams(query), question = { ...START };
  for (const name of PARAMETERS) question[name] = given.get(name) ?? START[name];
  if (Object.hasOwn(systems, given.get("numbers"))) question.numbers = given.get("numbers");
  if (given.get("plane") === "one") question.plane = "one";
  if (/^\d{1,5}$/.test(given.get("k"))) question.k = Number(given.get("k"));
  return question;
};
const address = question => {
  const changed = Object.entries(question).filter(([name, value]) => value !== START[name]);
  return `?${new URLSearchParams(changed.length ? changed : { k: START.k })}`;
};

const POSITIVE = ["c", "m", "eps"];

// The parameters as numbers, or error messages, by name.
const numbers = question => {
  const { read } = systems[question.numbers], values = {}, wrong = {};
  for (const name of PARAMETERS) {
    try {
      const exact = parse(question[name]);
      if (POSITIVE.includes(name) && exact.n <= 0n) throw RangeError("not greater than 0");
      values[name] = read(exact);
    } catch (error) {
      wrong[name] = error.message;
    }
  }
  return { values, wrong };
};

/* The recursion. */

// Maximum number of binary digits of a fraction, which grows with each step.
const LENGTH = 6000;

// A step from λ; it may be called thousands of times, so the object of quantities is reused.
const recursion = ({ numbers, plane }, values, f = systems[numbers].f) => {
  const prefix = plane === "one" ? "augmented::unilateral_" : "augmented::";
  const [deflection, penetration, update] = [f[`${prefix}deflection`], f["contact::penetration"], f[`${prefix}update`]];
  const all = { ...values, lambda: undefined, u: undefined };
  return lambda => {
    all.lambda = lambda;
    all.u = deflection(all);
    return { lambda, u: all.u, p: penetration(all), next: update(all) };
  };
};

// In how many steps λ is the same again, bit for bit; exactly it is at once or never.
const period = (system, step, { lambda, next }) => {
  for (let m = 1; m <= (system.precision ? 8 : 1); m += 1) {
    if (system.same(next, lambda)) return m;
    next = step(next).next;
  }
  return undefined;
};

// Steps 0 to k, or fewer if the numbers overflow; or, if `whole`, until λ repeats.
const run = (question, values, whole = false) => {
  const system = systems[question.numbers], step = recursion(question, values);
  const strict = recursion(question, values, system.strict);
  const last = Math.min(whole ? system.most : question.k, system.most);
  const rows = [], seen = new Set();
  let lambda = values.lambda, ended;
  for (;;) {
    try {
      rows.push(strict(lambda));
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      ended = "overflow";
      break;
    }
    const { next } = rows.at(-1);
    seen.add(lambda);
    if (!system.precision && bits(next.d) > LENGTH) ended = "length";
    else if (rows.length > system.most) ended = "most";
    if (ended || rows.length > last) break;
    if (whole && (seen.has(next) || system.same(next, lambda))) break;
    lambda = next;
  }
  return { question, values, system, rows, ended, period: ended ? undefined : period(system, step, rows.at(-1)) };
};

/* Analysis of a run. The values with which computed numbers are compared are computed in fractions. */

const exact = systems.exact.f;
const inFractions = ({ values, system }) =>
  Object.fromEntries(Object.entries(values).map(([name, value]) => [name, system.exactly(value)]));

// The penetration of a computed deflection.
const penetration = (run, { u }) => exact["contact::penetration"]({ ...inFractions(run), u: run.system.exactly(u) });

const verdict = run => {
  const { question, system, rows, ended, period } = run;
  const at = rows.at(-1), before = rows.at(-2), k = rows.length - 1;
  const one = question.plane === "one", values = inFractions(run);
  if (ended === "overflow") return { kind: "overflow", text: `A number of the next step is too large for ${system.name}.` };

  const reaction = exact["system::reaction"](values), apart = reaction.n < 0n;
  const force = one ? exact["contact::contact_force"](values) : reaction, name = one ? "⟨R⟩" : "R";
  const p = penetration(run, at), n = system.precision;
  const errorOf = lambda => magnitude(fractions.sub(system.exactly(lambda), force));
  const describeError = lambda => {
    const by = errorOf(lambda);
    return `${brief(by)} N${by.n && force.n ? ` (${share(fractions.div(by, magnitude(force)))} of it)` : ""}`;
  };
  const wrong = system.exactly(at.next), right = same(wrong, force);
  const off = right ? `the force λ + ε p is exactly ${name}` : `the force λ + ε p differs from ${name} = ${brief(force)} N by ${describeError(at.next)}`;
  const notes = [];
  if (apart && !one) notes.push("R < 0, and the plane pulls: (1.16) as printed describes a bilateral contact. With unilateral contact the mass would hang free.");
  if (apart && one && wrong.n) notes.push("R < 0: the mass will hang free once λ is 0.");
  if (ended === "most") notes.push(`The bench computes at most ${system.most} steps in this number system.`);
  if (ended === "length") notes.push(`The bench stops here: the denominator of λ has ${bits(at.next.d)} binary digits.`);
  const say = (kind, ...sentences) => ({ kind, p, error: errorOf(at.next), text: [...sentences, ...notes].join(" ") });

  // Bound on the penetration at a fixed point by note 8, evaluated exactly for the computed numbers.
  const bound = () => brief(exact["rounding::fixed_point_error"]({ ...values, lambda: system.exactly(at.lambda), n }));
  // Whether fewer than half of the digits of the force are right: then p is zero only by cancellation.
  const error = errorOf(at.next), lost = n && below(product(force, force), product(n, product(error, error)));
  if (at.p === 0 && lost) {
    return say("false zero", "The computed p is 0, and so λ repeats.",
      p.n ? `But at the computed u, p = ${brief(p)} m (the bound at a fixed point is ±${bound()} m);` : "At the computed u it is indeed 0,", `${p.n ? "" : "but "}${off}.`);
  }
  if (apart && one && !wrong.n) {
    return say("separated", `R = ${brief(reaction)} N < 0: the mass hangs free, ${brief(magnitude(p))} m above the plane, and λ stays 0.`);
  }
  if (period === 1 && !n) return say("fixed point", `p = 0, and ${off}: this is the solution.`);
  if (period === 1) {
    return say("fixed point", at.p === 0 ? "The computed p is 0, and so λ repeats." : "λ repeats bit for bit: ε p is too small to change it.",
      `At the computed u, p = ${brief(p)} m (within the bound ±${bound()} m); ${off}.`);
  }
  if (period > 1) {
    return say(`${period}-cycle`, `λ repeats after ${period} steps, but never after one: a test for two equal λ in a row never stops.`,
      `λ differs from ${name} = ${brief(force)} N by ${describeError(at.lambda)} now and by ${describeError(at.next)} in the next step.`);
  }
  // The quantity that tends to zero: the penetration or, with unilateral contact, the natural residual.
  const rest = row => system.exactly(one ? system.f["augmented::natural_residual"]({ ...run.values, ...row }) : row.p);
  const [now, then] = [at, before ?? at].map(rest);
  if (below(magnitude(then), magnitude(now)) || now.n * then.n < 0n) {
    return say("moving", `λ still changes, but only by rounding: the residual no longer falls. At the computed u, p = ${brief(p)} m, and ${off}.`);
  }
  const rho = exact["augmented::contraction"](values), less = fractions.sub(fractions.int(1), rho);
  const rate = below(less, { n: 1n, d: 100n }) ? `1 − ${brief(less)}` : brief(rho);
  return say("converging", `In exact arithmetic, each step multiplies R − λ by ρ = c/(c + ε) = ${rate}. At the computed u, p = ${brief(p)} m, and ${off}.`);
};
