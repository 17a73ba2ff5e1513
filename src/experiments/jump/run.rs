//! Counts independent chains at each σ, and finds the jump of the mode in each window.

use crate::experiments::ensembles::{Parts, join_counts};
use crate::experiments::prelude::*;
use impact_chain::mode_jump::{Histogram, ModeJump, Sample, mode_jump};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Jumps {
    pub ensembles: Vec<Ensemble>,
    pub windows: Vec<WindowJump>,
    /// The jump on rings with our protocol.
    pub ring: WindowJump,
    /// For several half widths of the smoothing of the bulk, the place with our protocol.
    pub widths: Vec<(usize, Option<Estimate>)>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindowJump {
    pub protocol: Protocol,
    pub jump: ModeJump,
    /// Numbers of chains by their count k = 0..=N, at each σ.
    pub histograms: Vec<Vec<u32>>,
}

impl WindowJump {
    pub fn chains(&self) -> u64 {
        self.histograms.iter().flatten().map(|count| u64::from(*count)).sum()
    }
}

/// Half widths over which the bulk is smoothed: ours, and those that must give the same place.
const HALF_WIDTH: usize = 6;
const HALF_WIDTHS: [usize; 4] = [3, 6, 9, 12];

impl Jumps {
    pub fn gaps(&self) -> usize {
        self.ensembles.first().map_or(0, |ensemble| ensemble.chain.gaps())
    }

    /// Returns the jump in a window, or `None` if the window was not counted.
    pub fn window(&self, protocol: Protocol) -> Option<&WindowJump> {
        self.windows.iter().find(|window| window.protocol == protocol)
    }
}

pub fn join(ensembles: &Vec<Ensemble>, parts: Parts, progress: &Progress) -> Result<Jumps, Error> {
    let (rings, walls): (Vec<_>, Vec<_>) =
        join_counts(ensembles, parts).partition(|one| one.0.chain.boundary == Boundary::Ring);
    let protocols = ensembles.first().map_or(&[][..], |ensemble| &ensemble.protocols);
    let samples = |window_index: usize| samples_of(&walls, window_index);
    let gaps = ensembles.first().map_or(0, |ensemble| ensemble.chain.gaps());
    let find_jump = |(window_index, &protocol): (usize, &Protocol)| {
        progress.check()?;
        Ok(window_jump(protocol, &samples(window_index), gaps))
    };
    let windows = protocols.par_iter().enumerate().with_max_len(1).map(find_jump);
    let windows = windows.collect::<Result<Vec<_>, Error>>()?;
    let ring_gaps = rings.first().map_or(0, |one| one.0.chain.gaps());
    let ring = window_jump(Protocol::default(), &samples_of(&rings, 0), ring_gaps);
    let ours = protocols.iter().position(|protocol| *protocol == Protocol::default());
    let place = |half_width: usize| {
        let jump = ours.map(|index| mode_jump(&samples(index), Histogram { gaps, half_width }));
        (half_width, jump.and_then(|jump| jump.all_gaps.sigma))
    };
    let widths = HALF_WIDTHS.into_par_iter().map(place).collect();
    Ok(Jumps { ensembles: ensembles.clone(), windows, ring, widths })
}

fn window_jump(protocol: Protocol, samples: &[Sample<'_>], gaps: usize) -> WindowJump {
    let histogram = |sample: &Sample<'_>| {
        let mut histogram = vec![0; gaps + 1];
        sample.counts.iter().flatten().for_each(|&k| histogram[k as usize] += 1);
        histogram
    };
    let histograms = samples.iter().map(histogram).collect();
    let jump = mode_jump(samples, Histogram { gaps, half_width: HALF_WIDTH });
    WindowJump { protocol, jump, histograms }
}

/// Returns the counts of a window at each σ.
fn samples_of(ensembles: &[(Ensemble, Vec<Counts>)], window_index: usize) -> Vec<Sample<'_>> {
    let samples = ensembles.iter().map(|(ensemble, counts)| Sample {
        sigma: ensemble.sigmas[0],
        counts: &counts[0].distinct[window_index],
        seed: ensemble.seed + ensemble.first,
    });
    samples.collect()
}
