//! Draws Fig. S7: speed against accuracy of a mean, the difference by each method from the engine's
//! mean against the time that the method takes, once for each question.

use super::prelude::*;
use super::rivals;
use crate::experiments::accuracy::answers;
use crate::experiments::accuracy::tables::{Compared, compared};
use crate::experiments::{BIAS, MEASURED};

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (biases, measured) = (results.of(&BIAS)?, results.of(&MEASURED)?);
    let rows = compared(biases);
    let means = &biases.parameters.means;
    let sheet = Sheet::new(7900);
    let clear = rows.iter().filter(|row| row.is_clear()).count();
    for (i, of) in means.iter().enumerate() {
        let chains = &of.chains;
        let time = |setting| {
            measured.thousand(measured.method(setting, chains.chain.masses, chains.sigma)?)
        };
        let (left, top) = (1200 + 3950 * (i as i32 % 2), 480 + 3150 * (i as i32 / 2));
        let frame = Frame::new(left, top, left + 3000, top + 2450);
        let mut x = Axis::decades(-2, 2, 1, "time (s)").between(0.04, 100.0);
        x.ticks.retain(|tick| tick.label.is_some());
        let x = x.column("time of one core for a thousand chains (s)");
        let x = if i < 2 { x.without_numbers() } else { x };
        let y = Axis::linear(-15.0, 15.0, 5.0, 1, "difference (%)").column("error of the mean (%)");
        let y = if i % 2 == 0 { y } else { y.without_numbers() };
        let panel = sheet.panel(frame, x, y)?.outside(Edge);
        panel.heading(LETTERS[i], &format!("*σ* = {}, *T* = {}", chains.sigma, of.transient))?;
        let tolerance = answers::MEANS.iter().find(|mean| mean.0 == chains.sigma);
        let tolerance = tolerance.map(|mean| 100.0 * mean.1);
        let band = tolerance.map(|t| [(panel.x.lo, -t), (panel.x.hi, t)]);
        let band = band.map(|corners| Rectangle::new(corners, GREY.mix(0.25).filled()));
        panel.draw_series("tolerance", band)?;
        panel.level("engine", 0.0, Stroke::solid(RED, HAIR))?;
        let own: Vec<_> = rows.iter().filter(|row| row.sigma == chains.sigma).collect();
        let point = |row: &&Compared| {
            let share = row.share?;
            let interval = share.interval.map(|end| 100.0 * end);
            let (setting, x) = (row.setting, time(row.setting)?);
            Some(rivals::Point { setting, x, y: 100.0 * share.value, interval: Some(interval) })
        };
        // Lines between settings would cross one another.
        let alone = rivals::all_by_method(&own, point).into_iter().flat_map(|(method, points)| {
            points.into_iter().map(move |point| (method, vec![point]))
        });
        rivals::draw(&panel, &alone.collect(), &[])?;
        let engine = Setting { method: MethodName::Certified, value: 0.0, stop: 0.0 };
        let at = time(engine).map(|time| (time, 0.0));
        panel.unrecorded().markers("engine", at.as_slice(), encoding::method(engine.method))?;
    }
    let methods = MethodName::ALL.into_iter().filter(|method| *method != MethodName::Truth);
    for (i, method) in methods.enumerate() {
        let (x, y) = ([1150, 3000, 4450, 6550][i % 4], 7200 + 400 * (i as i32 / 4));
        sheet.area.draw(&markers(vec![(x, y)], encoding::method(method)))?;
        let style = words(SMALL, INK, HPos::Left, VPos::Center);
        sheet.area.draw_text(method.title(), &style, (x + 190, y))?;
    }
    let description = describe!(
        "Difference of the mean number of impacting gaps from the engine's against time, for {} questions; each mark, with its 95 % interval, \
         is a method with a step or tolerance (at an edge: beyond it). Float32 Verlet is left of the engine and level with it; others are slower or off. {clear} of \
         {} differences are clear.",
        means.len(),
        rows.len(),
    );
    Ok(sheet.finish("Speed against accuracy of a mean", description))
}
