// Recipes whose slices are compared: each kind of noise, what changes it, and layers.
const oriented = (rest) => ({ type: "gabor-oriented", ...rest });
export const recipes = {
  gabor: { noise: { type: "gabor", frequency: 4 } },
  "gabor fine": { noise: { type: "gabor", frequency: 16, seed: 3 } },
  "gabor narrow": { noise: { type: "gabor", frequency: 6, bandwidth: 0.4 } },
  "gabor wide": { noise: { type: "gabor", frequency: 3, bandwidth: 2.5 } },
  "gabor octaves": { noise: { type: "gabor", frequency: 2, octaves: 4, gain: 0.6 } },
  "gabor filtered": { noise: { type: "gabor", frequency: 8 }, band_limit: true },
  "gabor poisson": { noise: { type: "gabor", frequency: 5, impulses_process: "poisson", impulses: 20 } },
  "gabor uniform": { noise: { type: "gabor", frequency: 5, weights: "uniform" } },
  oriented: { noise: oriented({ frequency: 5 }) },
  "oriented waves": { noise: oriented({ frequency: 6, anisotropy: 1, direction: [1, 0.5, 0, 0] }) },
  "oriented half": { noise: oriented({ frequency: 6, anisotropy: 0.5, direction: [0, 1, 0.3, 0] }) },
  "oriented evolving": { noise: oriented({ frequency: 4, evolve: 0.5 }), time: 0.7 },
  "oriented octaves": { noise: oriented({ frequency: 2, octaves: 5 }) },
  kensler: { noise: { type: "kensler", frequency: 6 } },
  "kensler octaves": { noise: { type: "kensler", frequency: 3, octaves: 4 } },
  cellular: { noise: { type: "cellular", frequency: 5 } },
  "four dimensions": { noise: { type: "gabor", frequency: 3 }, dims: 4, time: 0.25 },
  periodic: { noise: { type: "gabor", frequency: 4, period: [2, 2, 2, 0] } },
  moved: { noise: { type: "gabor", frequency: 4 }, offset: [100000, -3, 0.5] },
  unit: { noise: { type: "gabor", frequency: 4 }, shaping: { type: "raw", range: "unit" } },
  normalized: { noise: { type: "gabor", frequency: 2, period: [2, 2, 2, 0] }, shaping: { type: "raw", normalize: true } },
  exact: { noise: { type: "gabor", frequency: 3 }, exact: true },
  ridged: { noise: { type: "gabor", frequency: 3, octaves: 3 }, layers: [{ fold: "ridged", warp: { amount: 0.1 } }] },
  "two layers": {
    noise: { type: "kensler", frequency: 4 },
    layers: [{ fold: "billow" }, { noise: { type: "gabor", frequency: 9 }, weight: 0.4, ramp: [[-1, 0], [1, 1]] }],
  },
  "signed layers": {
    noise: { type: "gabor", frequency: 4, seed: 9, octaves: 2 }, shaping: { type: "raw", range: "signed" },
    layers: [
      { fold: "ridged", weight: 0.7, warp: { amount: 0.15 } },
      { noise: { type: "cellular", frequency: 7, seed: 5 }, weight: 0.5, ramp: [[-1, 0], [0, 0.3], [1, 1]] },
    ],
  },
};
export const textOf = (name) => JSON.stringify({ solidnoise: 2, shaping: { type: "raw" }, ...recipes[name] });
