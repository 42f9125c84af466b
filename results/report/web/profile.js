// Performance profiles, recomputed for the solvers that are shown: they depend on who is compared.
// The same as results/profiles.cpp computes them for all. No DOM here.

const SHORTEST_S = 1e-6; // below it a clock says nothing

const solved = (time) => typeof time === 'number';

/**
 * `times`: of each solver its time on each problem [s]: null if not solved, false if not run.
 * `shown`: of each solver whether it is compared. Of each solver that is, the steps {x: [ratio],
 * y: [share]} and how many problems it solves; of the others no steps. Problems that a solver shown
 * was not run on are left out.
 */
export function performanceProfiles(times, shown) {
  const compared = times.filter((_, s) => shown[s]);
  const rows = [...(compared[0]?.keys() ?? [])].filter((row) => compared.every((of) => of[row] !== false));
  const floored = (time) => Math.max(time, SHORTEST_S);
  const fastest = new Map(
    rows.map((row) => [row, Math.min(...compared.map((of) => (solved(of[row]) ? floored(of[row]) : Infinity)))]),
  );
  return times.map((of, s) => {
    if (!shown[s]) return { x: [], y: [], solved: 0, problems: rows.length };
    const ratios = rows
      .filter((row) => solved(of[row]))
      .map((row) => floored(of[row]) / fastest.get(row))
      .sort((a, b) => a - b);
    const x = [];
    const y = [];
    ratios.forEach((ratio, i) => {
      if (ratios[i + 1] === ratio) return;
      x.push(ratio);
      y.push((i + 1) / rows.length);
    });
    return { x, y, solved: ratios.length, problems: rows.length };
  });
}

/** The variant of a plot with its profiles made anew for the solvers that `has` holds. */
export function comparedAnew(variant, has) {
  const profiles = performanceProfiles(variant.series.map((series) => series.times), variant.series.map((series) => has(series.name)));
  const series = variant.series.map((one, s) => {
    const { x, y, solved: count, problems } = profiles[s];
    const inside = x.filter((ratio) => ratio <= variant.x.high).length;
    return { ...one, x: x.slice(0, inside), y: y.slice(0, inside), note: has(one.name) ? `${count}/${problems}` : '' };
  });
  return { ...variant, series };
}
