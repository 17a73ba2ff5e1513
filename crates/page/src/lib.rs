//! The functions that a page of the report calls, as WebAssembly. Numbers are passed directly;
//! texts and lists lie in memory that is valid until the next call.
//!
//! - [`room`], [`open`], [`advance`]: one run of the engine at a time.
//! - [`law`], [`p_of_sigma`], [`mean`], [`k_star`]: the theory.
//! - [`text`] with [`text_length`], [`numbers`], [`picture`]: where the results lie.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![deny(unsafe_op_in_unsafe_fn)]

use impact_chain::replay::{Forces, Replay, Request};
use impact_chain::{Boundary, Chain, Start};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::jump;
use std::cell::RefCell;

/// Columns of the picture in space and time.
const COLUMNS: usize = 640;

#[derive(Default)]
struct Page {
    run: Option<(Replay, f64)>,
    /// Impacts of each gap in each column.
    picture: Vec<u32>,
    text: Vec<u8>,
    numbers: Vec<f64>,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

impl Page {
    fn set_text(&mut self, text: impl ToString) {
        self.text = text.to_string().into_bytes();
    }

    /// Starts the run that numbers and text describe.
    fn open(&mut self) -> Result<(), String> {
        self.run = None;
        let request = request(&self.numbers, &String::from_utf8_lossy(&self.text))?;
        let run = Replay::new(&request).map_err(|error| error.to_string())?;
        self.picture = vec![0; COLUMNS * run.gaps()];
        self.run = Some((run, request.until()));
        Ok(())
    }

    /// Advances the run by at most `impacts` impacts; returns whether there may be more.
    fn advance(&mut self, impacts: u64) -> Result<bool, String> {
        let Some((run, until)) = &mut self.run else { return Ok(false) };
        let picture = &mut self.picture;
        let on = run.advance(impacts, |time, gap| {
            let column = ((time / *until * COLUMNS as f64) as usize).min(COLUMNS - 1);
            picture[gap * COLUMNS + column] += 1;
        });
        let done = run.engine();
        self.numbers = vec![
            if on == Ok(true) { done.time() } else { *until },
            done.counters().impacts as f64,
            run.distinct() as f64,
            run.gaps() as f64,
            COLUMNS as f64,
        ];
        self.text = run.digest().into_bytes();
        on.map_err(|error| error.to_string())
    }
}

/// A run from numbers in this order: T, W, the chain (n, d, ω, Ω, r, 1 for a ring, start 0 rest,
/// 1 zero or 2 random), then σ, seed and realisation of the stream that the text names; without
/// one, α and β of each mass.
fn request(numbers: &[f64], stream: &str) -> Result<Request, String> {
    let [transient, window, n, spacing, natural, forcing, restitution, ring, start, rest @ ..] =
        numbers
    else {
        return Err("numbers are missing".into());
    };
    let chain = Chain {
        masses: *n as usize,
        spacing: *spacing,
        natural_frequency: *natural,
        forcing_frequency: *forcing,
        restitution: *restitution,
        boundary: if *ring == 1.0 { Boundary::Ring } else { Boundary::Walls },
        start: match *start as usize {
            0 => Start::Rest,
            1 => Start::Zero,
            _ => Start::Random,
        },
    };
    let forces = match (rest, stream) {
        (pairs, "") => {
            Forces::Given(pairs.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect())
        }
        ([sigma, seed, realisation], _) => Forces::Drawn {
            sigma: *sigma,
            stream: stream.into(),
            seed: *seed as u64,
            realisation: *realisation as u64,
        },
        _ => return Err("a stream has sigma, seed and realisation".into()),
    };
    Ok(Request { chain, forces, transient: *transient, window: *window })
}

/// Runs `work` on the page: 1 or 0 for its result, or 2 with the refusal as the text.
fn answer(work: impl FnOnce(&mut Page) -> Result<bool, String>) -> u32 {
    PAGE.with_borrow_mut(|page| match work(page) {
        Ok(on) => u32::from(on),
        Err(refused) => {
            page.set_text(refused);
            2
        }
    })
}

/// Makes room for a text of so many bytes and for so many numbers, into which the page writes its
/// arguments.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize, numbers: usize) {
    PAGE.with_borrow_mut(|page| {
        page.text = vec![0; bytes];
        page.numbers = vec![0.0; numbers];
    });
}

/// Starts the run that numbers and text describe: 0, or 2 with the reason as the text.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> u32 {
    answer(|page| page.open().map(|()| false))
}

/// Advances by so many impacts at most: 1 if there may be more, 0 at the end, 2 if it failed. The
/// numbers are then time, impacts, different gaps in the window, gaps, and columns of the picture;
/// the text is the digest, or the error.
#[unsafe(no_mangle)]
pub extern "C" fn advance(impacts: u32) -> u32 {
    answer(|page| page.advance(impacts.into()))
}

/// The circuits of N vertices with edge probability p, into the numbers: k*, μ, p_crit, p_jump,
/// k− and k+ (−1 where one does not exist), then P(X = k) for k = 1..N, then f(k).
#[unsafe(no_mangle)]
pub extern "C" fn law(vertices: usize, p: f64) -> u32 {
    answer(|page| {
        let message = |error: impact_circuits::Error| error.to_string();
        let law = Law::new(SampleSpace::Simple, vertices, p).map_err(message)?;
        let after = jump::p_jump(SampleSpace::Simple, vertices).map_or(-1.0, |jump| jump.p);
        let [minus, plus] = jump::zeros(vertices, p).unwrap_or([-1.0; 2]);
        let crit = jump::p_crit(vertices).map_err(message)?;
        page.numbers = vec![law.k_star() as f64, law.mean(), crit, after, minus, plus];
        page.numbers.extend(law.probabilities());
        page.numbers.extend((1..=vertices).map(|k| jump::f(vertices, p, k as f64)));
        Ok(false)
    })
}

/// Returns p(σ) of the paper's chain by Eq. (25); 0 where it is too small for a number.
#[unsafe(no_mangle)]
pub extern "C" fn p_of_sigma(sigma: f64) -> f64 {
    ImpactProbability::of_paper(sigma).and_then(|law| law.p()).unwrap_or(0.0)
}

/// Returns μ of this many vertices at p, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn mean(vertices: usize, p: f64) -> f64 {
    Law::new(SampleSpace::Simple, vertices, p).map_or(-1.0, |law| law.mean())
}

/// Returns k* of this many vertices at p, or −1.
#[unsafe(no_mangle)]
pub extern "C" fn k_star(vertices: usize, p: f64) -> f64 {
    Law::new(SampleSpace::Simple, vertices, p).map_or(-1.0, |law| law.k_star() as f64)
}

/// Returns the address of the text.
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    PAGE.with_borrow(|page| page.text.as_ptr())
}

/// Returns the bytes of the text.
#[unsafe(no_mangle)]
pub extern "C" fn text_length() -> usize {
    PAGE.with_borrow(|page| page.text.len())
}

/// Returns the address of the numbers.
#[unsafe(no_mangle)]
pub extern "C" fn numbers() -> *const f64 {
    PAGE.with_borrow(|page| page.numbers.as_ptr())
}

/// Returns the address of the picture: gap by gap, the impacts of each column of time.
#[unsafe(no_mangle)]
pub extern "C" fn picture() -> *const u32 {
    PAGE.with_borrow(|page| page.picture.as_ptr())
}

#[cfg(test)]
mod tests {
    use super::*;

    const NUMBERS: [f64; 12] = [50.0, 20.0, 30.0, 1.0, 1.0, 1.5, 0.8, 0.0, 0.0, 0.3, 1.0, 4.0];

    fn opened(stream: &str, numbers: &[f64]) -> Result<Page, String> {
        let mut page = Page { text: stream.into(), numbers: numbers.into(), ..Page::default() };
        page.open().map(|()| page)
    }

    #[test]
    fn numbers_and_a_name_are_a_run() {
        let mut page = opened("page", &NUMBERS).unwrap();
        while page.advance(10).unwrap() {}
        let chain = Chain { masses: 30, forcing_frequency: 1.5, ..Chain::default() };
        let stream = "page".into();
        let forces = Forces::Drawn { sigma: 0.3, stream, seed: 1, realisation: 4 };
        let request = Request { chain, forces, transient: 50.0, window: 20.0 };
        let mut run = Replay::new(&request).unwrap();
        run.advance(u64::MAX, |_, _| ()).unwrap();
        assert_eq!(page.text, run.digest().into_bytes());
        let impacts = run.engine().counters().impacts as f64;
        assert_eq!(page.numbers, [70.0, impacts, run.distinct() as f64, 31.0, COLUMNS as f64]);
        assert!(impacts > 100.0);
        assert_eq!(page.picture.iter().sum::<u32>() as f64, impacts);
        let none = opened("", &NUMBERS[..9]).map(|_| ()).unwrap_err();
        assert!(none.starts_with("forcing: it has 0 pairs for 30 masses; give one"), "{none}");
        // Amplitudes one by one, without a stream.
        let pairs = request.scenario().unwrap().forcing;
        let given: Vec<f64> =
            NUMBERS[..9].iter().copied().chain(pairs.into_iter().flatten()).collect();
        let mut page = opened("", &given).unwrap();
        page.advance(u64::MAX).unwrap();
        assert_eq!(page.text, run.digest().into_bytes());
    }

    #[test]
    fn the_law_is_that_of_the_theory() {
        assert_eq!(law(100, f64::NAN), 2);
        assert_eq!(law(100, 0.02), 0);
        let numbers = PAGE.with_borrow(|page| page.numbers.clone());
        assert_eq!(numbers.len(), 6 + 2 * 100);
        assert!((numbers[6..106].iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert_eq!((numbers[0], numbers[1]), (k_star(100, 0.02), mean(100, 0.02)));
        assert!(
            numbers[2] < numbers[3] && numbers[4] < numbers[5] && numbers[5].ceil() == numbers[0]
        );
        assert!(p_of_sigma(0.01) == 0.0 && p_of_sigma(0.2) > p_of_sigma(0.1));
    }
}
