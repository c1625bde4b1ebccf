use super::*;
use faer::c64;

/// A chain of `links` links of three coordinates, each held to the one before by two rows, the last `copies` rows
/// twice.
struct Chain {
    mass: Pattern,
    tangent: Pattern,
    g: Pattern,
    masses: Vec<f64>,
    stiffness: Vec<f64>,
    rows: Vec<f64>,
}

/// Numbers in [-1, 1] without pattern.
fn arbitrary(k: usize) -> f64 {
    (1.0 + 0.7 * k as f64 * (k as f64 + 3.0)).sin()
}

fn chain(links: usize, copies: usize) -> Chain {
    let n = 3 * links;
    let mass = Pattern::diagonal(n);
    let near = |i: usize| (i.saturating_sub(3)..(i + 4).min(n)).map(move |j| (i, j));
    let tangent = Pattern { rows: n, cols: n, entries: (0..n).flat_map(near).collect() };
    let mut g = Pattern { rows: 2 * links + copies, cols: n, entries: vec![] };
    let mut rows = vec![];
    for i in 0..g.rows {
        let told = if i < 2 * links { i } else { i - copies };
        let columns = (3 * (told / 2)).saturating_sub(3)..3 * (told / 2) + 3;
        columns.for_each(|j| {
            g.entries.push((i, j));
            rows.push(1e3 * (arbitrary(7 * told + j) + if j % 3 == told % 2 { 2.0 } else { 0.0 }));
        });
    }
    let stiffness = (0..tangent.entries.len()).map(|k| 1e-3 * arbitrary(k)).collect();
    Chain { masses: (0..n).map(|i| 1.0 + 0.1 * arbitrary(i)).collect(), mass, tangent, g, stiffness, rows }
}

/// The part of a number that a real matrix can have.
trait Made: Field {
    fn made(re: f64, im: f64) -> Self;
}
impl Made for f64 {
    fn made(re: f64, _: f64) -> f64 {
        re
    }
}
impl Made for c64 {
    fn made(re: f64, im: f64) -> c64 {
        c64::new(re, im)
    }
}

impl Chain {
    fn system<T: Field>(&self, is_dense: bool) -> Unsymmetric<T> {
        Unsymmetric::at(matrix::places(&self.mass, &self.tangent, &self.g).unwrap(), &self.g, is_dense).unwrap()
    }

    fn put<T: Made>(&self, system: &mut Unsymmetric<T>) {
        system.clear();
        system.add(&self.mass, &self.masses, T::made(2.0, 1.0), true);
        system.add(&self.tangent, &self.stiffness, T::made(1.0, -3.0), false);
    }

    /// [A G^T; G 0] times (a, lambda).
    fn multiply<T: Made>(&self, a: &[T], lambda: &[T]) -> (Vec<T>, Vec<T>) {
        let mut top = vec![T::ZERO; a.len()];
        let mut bottom = vec![T::ZERO; lambda.len()];
        for (i, &m) in self.masses.iter().enumerate() {
            top[i] += a[i] * T::made(2.0, 1.0) * m;
        }
        for (&(i, j), &k) in self.tangent.entries.iter().zip(&self.stiffness) {
            top[i] += a[j] * T::made(1.0, -3.0) * k;
        }
        for (&(i, j), &g) in self.g.entries.iter().zip(&self.rows) {
            bottom[i] += a[j] * g;
            top[j] += lambda[i] * g;
        }
        (top, bottom)
    }
}

/// Factors twice, solves, and compares what the solution multiplies to.
fn check<T: Made>(links: usize, copies: usize, is_dense: bool) {
    let chain = chain(links, copies);
    let mut system = chain.system::<T>(is_dense);
    let numbers = |n: usize| (0..n).map(|k| T::made(arbitrary(k), arbitrary(k + 5))).collect::<Vec<_>>();
    let a = numbers(chain.g.cols);
    let lambda = numbers(chain.g.rows);
    let (first, second) = chain.multiply(&a, &lambda);
    for _ in 0..2 {
        chain.put(&mut system);
        system.factor(&chain.g, &chain.rows).unwrap();
        assert_eq!(system.left_out().iter().filter(|out| **out).count(), copies);
        let mut top = first.clone();
        let mut bottom = second.clone();
        system.solve(&mut top, &mut bottom).unwrap();
        let left_out = system.left_out().iter().zip(&bottom).filter(|(out, _)| **out);
        assert!(left_out.into_iter().all(|(_, lambda)| lambda.size() == 0.0));
        let close = |found: &[T], exact: &[T]| {
            found.iter().zip(exact).all(|(f, e)| (*f * 1.0 + *e * -1.0).size() < 1e-11 * (1.0 + e.size()))
        };
        assert!(close(&top, &a), "{links} {copies} {is_dense}");
        let (again, rows) = chain.multiply(&top, &bottom);
        let close =
            |found: &[T], exact: &[T]| found.iter().zip(exact).all(|(f, e)| (*f * 1.0 + *e * -1.0).size() < 1e-8);
        assert!(close(&again, &first) && close(&rows, &second), "{links} {copies} {is_dense}");
    }
}

#[test]
fn solves_what_it_multiplied() {
    for copies in [0, 1, 4] {
        for is_dense in [true, false] {
            check::<f64>(6, copies, is_dense);
            check::<c64>(6, copies, is_dense);
        }
        check::<f64>(300, copies, false);
        check::<c64>(300, copies, false);
    }
}

/// With the dropped rows given, no others are; without, those of the values at hand are, whatever was factored before.
#[test]
fn a_rank_that_changes_is_singular_only_where_the_dropped_rows_are_given() {
    for is_dense in [true, false] {
        for copies in [0, 1] {
            let one = chain(6, copies);
            let mut twice = one.rows.clone();
            // The rows of the second link have six entries each, after three and three of the first.
            twice.copy_within(6..12, 12);
            let mut system = one.system::<f64>(is_dense);
            for (rows, dropped) in [(&one.rows, copies), (&twice, copies + 1), (&one.rows, copies)] {
                one.put(&mut system);
                system.factor(&one.g, rows).unwrap();
                assert_eq!(system.left_out().iter().filter(|out| **out).count(), dropped);
            }
            let dropped: Vec<usize> = (0..one.g.rows).filter(|row| system.left_out()[*row]).collect();
            system.drop_rows(&dropped);
            one.put(&mut system);
            assert_eq!(system.factor(&one.g, &twice), Err(Singular::Collapsed));
            assert!(system.solve(&mut [1.0; 18], &mut vec![0.0; one.g.rows]).is_err());
            one.put(&mut system);
            assert_eq!(system.factor(&one.g, &one.rows), Ok(()));
        }
    }
}

#[test]
fn a_coordinate_without_mass_is_held_by_its_rows() {
    let mass = Pattern { rows: 2, cols: 2, entries: vec![(0, 0)] };
    let g = Pattern::dense(1, 2);
    for is_dense in [true, false] {
        let mut system =
            Unsymmetric::<f64>::at(matrix::places(&mass, &Pattern::default(), &g).unwrap(), &g, is_dense).unwrap();
        system.add(&mass, &[2.0], 1.0, true);
        system.factor(&g, &[1.0, 1.0]).unwrap();
        let mut top = [5.0, 1.0];
        let mut bottom = [3.0];
        system.solve(&mut top, &mut bottom).unwrap();
        assert!((top[0] - 2.0).abs() < 1e-15 && (top[1] - 1.0).abs() < 1e-15 && (bottom[0] - 1.0).abs() < 1e-15);
    }
}

/// Two rows share a coordinate without mass, whose own entry of A is h^2 K or round-off of that: they are not
/// dependent.
#[test]
fn a_coordinate_without_mass_does_not_make_its_rows_dependent() {
    let mass = Pattern::diagonal(3);
    let tangent = Pattern { rows: 3, cols: 3, entries: vec![(2, 2)] };
    let g = Pattern::dense(2, 3);
    let rows = [1.0, 0.0, 1.0, 0.0, 1.0, 2.0];
    for is_dense in [true, false] {
        for stiffness in [0.0, 1e-30, 1e-18, 1e-9, 1.0, 1e3] {
            let mut system =
                Unsymmetric::<f64>::at(matrix::places(&mass, &tangent, &g).unwrap(), &g, is_dense).unwrap();
            system.see_mass(&mass, &[1.0, 1.0, 0.0]);
            system.add(&mass, &[1.0, 1.0, 0.0], 1.0, true);
            system.add(&tangent, &[1.0], stiffness, false);
            system.factor(&g, &rows).unwrap();
            assert!(!system.left_out().contains(&true));
            // a = (1, 2, 3), lambda = (4, 5)
            let mut top = [5.0, 7.0, 14.0 + 3.0 * stiffness];
            let mut bottom = [4.0, 8.0];
            system.solve(&mut top, &mut bottom).unwrap();
            let found = top.iter().chain(&bottom).zip([1.0, 2.0, 3.0, 4.0, 5.0]);
            found.for_each(|(found, exact)| assert!((found - exact).abs() < 1e-13, "{stiffness:e}: {found} {exact}"));
        }
    }
}

#[test]
fn rows_that_are_held_are_dropped_and_no_others() {
    let one = chain(6, 1);
    let mut system = one.system::<f64>(false);
    for (rows, is_regular) in [(vec![12], true), (vec![], false), (vec![11], true)] {
        one.put(&mut system);
        system.drop_rows(&rows);
        assert_eq!(system.factor(&one.g, &one.rows).is_ok(), is_regular, "{rows:?}");
    }
}

/// The diagonal alone gives the solution of partial pivoting, also once rows that depend on others are dropped; with an A
/// that needs partial pivoting the same.
#[test]
fn a_small_pivot_leads_to_partial_pivoting() {
    for (copies, stiffness, is_unpivoted) in [(0, 1.0, true), (0, -999.999_999_99, false), (1, 1.0, true)] {
        let mut chain = chain(30, copies);
        let diagonal = chain.tangent.entries.iter().position(|&(i, j)| (i, j) == (0, 0)).unwrap();
        (chain.stiffness[diagonal], chain.masses[0]) = (stiffness, 500.0);
        let mut systems = [chain.system::<f64>(false), chain.system::<f64>(false).for_corrections()];
        let found = systems.each_mut().map(|system| {
            system.clear();
            system.add(&chain.mass, &chain.masses, 2.0, true);
            system.add(&chain.tangent, &chain.stiffness, 1.0, false);
            system.factor(&chain.g, &chain.rows).unwrap();
            let mut top = vec![1.0; chain.g.cols];
            let mut bottom = vec![1.0; chain.g.rows];
            system.solve(&mut top, &mut bottom).unwrap();
            [top, bottom].concat()
        });
        assert_eq!((systems[0].is_unpivoted, systems[1].is_unpivoted), (false, is_unpivoted), "{copies} {stiffness}");
        assert_eq!(systems[0].left_out(), systems[1].left_out());
        let [pivoted, diagonal] = &found;
        // Ten digits less what the condition of the chain takes.
        let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9 * (1.0 + a.abs());
        assert!(pivoted.iter().zip(diagonal).all(close), "{copies} {stiffness}");
    }
}

/// Large matrices are factored and solved in parts.
#[test]
fn a_long_chain_is_divided() {
    divided::<f64>();
    divided::<c64>();
}

fn divided<T: Made>() {
    let chain = chain(8000, 0);
    let mut system = chain.system::<T>(false).for_corrections();
    let numbers = |n: usize| (0..n).map(|k| T::made(arbitrary(k), arbitrary(k + 5))).collect::<Vec<_>>();
    let a = numbers(chain.g.cols);
    let lambda = numbers(chain.g.rows);
    chain.put(&mut system);
    system.factor(&chain.g, &chain.rows).unwrap();
    assert!(system.is_unpivoted && system.unpivoted.as_ref().is_some_and(|factors| factors.parts.len() == 4));
    let (mut top, mut bottom) = chain.multiply(&a, &lambda);
    system.solve(&mut top, &mut bottom).unwrap();
    // Ten digits less what the condition of the chain takes.
    assert!(top.iter().zip(&a).all(|(found, exact)| (*found * 1.0 + *exact * -1.0).size() < 1e-9));
}

#[test]
fn what_does_not_fit_is_refused() {
    let chain = chain(3, 0);
    let mut system = chain.system::<f64>(false);
    system.add(&Pattern { rows: 9, cols: 9, entries: vec![(0, 8)] }, &[1.0], 1.0, false);
    assert_eq!(system.factor(&chain.g, &chain.rows), Err(Singular::Shape));
    system.clear();
    system.add(&chain.mass, &[f64::NAN; 9], 1.0, true);
    assert_eq!(system.factor(&chain.g, &chain.rows), Err(Singular::NotFinite));
}

/// Where the sparse factors win over the dense ones: `cargo test --release crossover -- --ignored --nocapture`.
#[test]
#[ignore = "measures"]
fn crossover() {
    for links in [4, 8, 12, 16, 20, 24, 28, 32, 48, 200, 2000, 20000] {
        let times = [true, false].map(|is_dense| {
            let time = |factor: fn(&Chain, usize, bool) -> f64| {
                if is_dense && links > 200 { f64::NAN } else { factor(&chain(links, 0), links, is_dense) }
            };
            [time(seconds::<f64>), time(seconds::<c64>)].map(|seconds| 1e6 * seconds)
        });
        println!("{:6} dense {:9.1?} sparse {:9.1?} us (real, complex)", 5 * links, times[0], times[1]);
    }
}

fn seconds<T: Made>(chain: &Chain, links: usize, is_dense: bool) -> f64 {
    let mut system = chain.system::<T>(is_dense);
    let mut top = vec![T::real(1.0); chain.g.cols];
    let mut bottom = vec![T::real(1.0); chain.g.rows];
    let mut round = || {
        chain.put(&mut system);
        system.factor(&chain.g, &chain.rows).unwrap();
        (0..3).for_each(|_| system.solve(&mut top, &mut bottom).unwrap());
    };
    round();
    let rounds = 20_000 / links + 1;
    let start = std::time::Instant::now();
    (0..rounds).for_each(|_| round());
    start.elapsed().as_secs_f64() / rounds as f64
}
