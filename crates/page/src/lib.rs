//! The functions that a page of the report calls, as WebAssembly. Numbers are passed directly;
//! texts and lists lie in memory that is valid until the next call.
//!
//! - [`room`], [`open`], [`advance`]: one run of the engine at a time; [`follow`] shows its masses.
//! - [`law`], [`p_of_sigma`], [`mean`], [`k_star`]: the theory.
//! - [`text`] with [`text_length`], [`numbers`], [`picture`]: where the results lie.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![deny(unsafe_op_in_unsafe_fn)]

use impact_chain::{
    Boundary, Chain, End, Engine, Event, Impact, NormalPairs, Scenario, Seed, Start,
};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::jump;
use sha2::{Digest, Sha256};
use std::cell::RefCell;
use std::ops::ControlFlow::{Break, Continue};

/// Columns of the picture in space and time.
const COLUMNS: usize = 640;

/// A run that is advanced piece by piece.
struct Run {
    engine: Engine,
    transient: f64,
    until: f64,
    /// Whether each gap has an impact in the window.
    hit: Vec<bool>,
    /// Of each impact the time, the gap as the engine numbers it, and the closing speed; eight
    /// bytes each, the lowest first, doubles bit by bit.
    hash: Sha256,
}

#[derive(Default)]
struct Page {
    run: Option<Run>,
    /// Impacts of each gap in each column.
    picture: Vec<u32>,
    text: Vec<u8>,
    numbers: Vec<f64>,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

impl Page {
    /// Starts the run that numbers and text describe.
    fn open(&mut self) -> Result<(), String> {
        self.run = None;
        let stream = String::from_utf8_lossy(&self.text);
        let ([transient, window], scenario) = read_request(&self.numbers, &stream)?;
        let until = transient + window;
        let engine = Engine::new(&scenario).map_err(|error| error.to_string())?;
        let gaps = scenario.gaps();
        self.picture = vec![0; COLUMNS * gaps];
        self.run =
            Some(Run { engine, transient, until, hit: vec![false; gaps], hash: Sha256::new() });
        Ok(())
    }

    /// Advances the run by at most `most` impacts; returns whether there may be more.
    fn advance(&mut self, most: u64) -> Result<bool, String> {
        let Some(Run { engine, transient, until, hit, hash }) = &mut self.run else {
            return Ok(false);
        };
        let (gaps, mut left) = (hit.len(), most);
        let ended = engine.run(*until, |event, _| {
            let Event::Impact(Impact { time, gap, closing_speed }) = *event else {
                return Continue(());
            };
            for bits in [time.to_bits(), gap as u64, closing_speed.to_bits()] {
                hash.update(bits.to_le_bytes());
            }
            // Gaps of a ring are numbered from 1.
            let gap = gap % gaps;
            hit[gap] |= time > *transient;
            let column = ((time / *until * COLUMNS as f64) as usize).min(COLUMNS - 1);
            self.picture[gap * COLUMNS + column] += 1;
            left = left.saturating_sub(1);
            if left > 0 { Continue(()) } else { Break(()) }
        });
        let distinct = hit.iter().filter(|hit| **hit).count();
        self.numbers = vec![
            if ended == Ok(End::Stopped) { engine.time() } else { *until },
            engine.counters().impacts as f64,
            distinct as f64,
            gaps as f64,
            COLUMNS as f64,
        ];
        let digest = hash.clone().finalize();
        self.text = digest.iter().map(|byte| format!("{byte:02x}")).collect::<String>().into();
        ended.map(|end| end == End::Stopped).map_err(|error| error.to_string())
    }
}

/// Reads T, W and a scenario from numbers in this order: T, W, the chain (n, d, ω, Ω, r, 1 for a
/// ring, start 0 rest, 1 zero or 2 random), then σ, seed and realisation of the stream that the
/// text names; without one, α and β of each mass.
fn read_request(numbers: &[f64], stream: &str) -> Result<([f64; 2], Scenario), String> {
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
    let scenario = match (rest, stream) {
        (pairs, "") => {
            let pairs = pairs.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
            Scenario::given(&chain, pairs).map_err(|error| error.to_string())?
        }
        ([sigma, seed, realisation], _) => {
            let mut normals = NormalPairs::new(stream, Seed(*seed as u64), *realisation as u64);
            Scenario::draw(&chain, *sigma, &mut normals)
        }
        _ => return Err("a stream has sigma, seed and realisation".into()),
    };
    Ok(([*transient, *window], scenario))
}

/// Runs `work` on the page: 1 or 0 for its result, or 2 with the refusal as the text.
fn answer(work: impl FnOnce(&mut Page) -> Result<bool, String>) -> u32 {
    PAGE.with_borrow_mut(|page| match work(page) {
        Ok(may_go_on) => u32::from(may_go_on),
        Err(message) => {
            page.text = message.into_bytes();
            2
        }
    })
}

/// Makes room for a text of so many bytes and for numbers, which the page writes.
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

/// Advances to a time, which is not before the last: 0, or 2 if it failed. The numbers are then the
/// positions of all masses, how many impacts there were since the last time, and their gaps.
#[unsafe(no_mangle)]
pub extern "C" fn follow(time: f64) -> u32 {
    answer(|page| {
        let engine = &mut page.run.as_mut().ok_or("nothing is open")?.engine;
        let message = |error: impact_chain::Error| error.to_string();
        let impacts = engine.impacts(time).map_err(message)?;
        page.numbers = engine.state(time).map_err(message)?.positions;
        page.numbers.push(impacts.len() as f64);
        page.numbers.extend(impacts.iter().map(|impact| impact.gap as f64));
        Ok(false)
    })
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

    #[test]
    fn masses_are_followed_from_impact_to_impact() {
        let fields = [50.0, 20.0, 30.0, 1.0, 1.0, 1.5, 0.8, 0.0, 0.0].into_iter();
        let numbers: Vec<f64> = fields.chain((0..60).map(|i| f64::from(i % 5) - 2.0)).collect();
        let (_, scenario) = read_request(&numbers, "").unwrap();
        let impacts = Engine::new(&scenario).unwrap().impacts(50.0).unwrap();
        PAGE.set(Page { numbers, ..Page::default() });
        let after = |time: i32| {
            assert_eq!(follow(f64::from(time)), 0);
            PAGE.with_borrow(|page| page.numbers[30] as usize)
        };
        assert_eq!(open(), 0);
        assert_eq!((1..=50).map(after).sum::<usize>(), impacts.len());
    }

    #[test]
    fn what_is_no_run_and_no_probability_is_refused() {
        let numbers = vec![50.0, 20.0, 30.0, 1.0, 1.0, 1.5, 0.8, 0.0, 0.0];
        let message = Page { numbers, ..Page::default() }.open().unwrap_err();
        assert!(
            message.starts_with("forcing: it has 0 pairs for 30 masses; give one"),
            "{message}"
        );
        assert_eq!([law(100, f64::NAN), law(100, 0.02)], [2, 0]);
    }
}
