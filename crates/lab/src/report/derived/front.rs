//! The Pareto front of error against cost, and the price of each tenfold of accuracy along it.
//!
//! An offer is on the front if no other offer has at most its error at no more than its cost. From one offer of the front to the next,
//! error falls by some decades and cost rises by some factor; the price of a tenfold is this factor per decade, so that steps of any
//! length can be compared: `(c1 / c0) ^ (1 / log10(e0 / e1))`. A step to an error of 0 has no number of decades: only its factor is given.
//!
//! Over a short step the root amplifies the scatter, and a cost difference within the spreads may be no difference: neither has a price.
//! A strategy that did not draw all of a frame has fewer errors and less cost for the wrong reason, and is on no front.

/// Error and cost of one strategy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offer {
    /// Error, 0 or more.
    pub error: f64,
    /// Cost, greater than 0.
    pub cost: f64,
    /// Median absolute deviation of the cost; none where it is not known.
    pub spread: Option<f64>,
    /// True if all of the frame was drawn.
    pub is_complete: bool,
}

/// Price of a tenfold smaller error along a step of a front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepPrice {
    /// Factor on the cost.
    Factor(f64),
    /// There is no error left: no number of tenfolds.
    ToNoError,
    /// Error falls by less than [`LEAST_DECADES`].
    TooShort,
    /// The two costs lie within the sum of their spreads: the step may be free.
    WithinSpread,
}

/// Minimum decades of error in a step that has a price: at a third, a scatter of 10 % in cost gives a third in price.
const LEAST_DECADES: f64 = 1.0 / 3.0;

/// From one offer of a front to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrontStep {
    /// Index of the cheaper offer.
    pub from: usize,
    /// Index of the more accurate offer.
    pub to: usize,
    /// Cost of the second over that of the first.
    pub cost_ratio: f64,
    /// Price of a tenfold smaller error.
    pub price: StepPrice,
    /// True if the spreads of both costs are known.
    pub is_spread_known: bool,
}

/// Indices of the complete offers on the front, the cheapest first. Of equal offers the first is taken.
pub(crate) fn front(offers: &[Offer]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..offers.len())
        .filter(|i| offers[*i].is_complete)
        .collect();
    order.sort_by(|a, b| {
        let (a, b) = (&offers[*a], &offers[*b]);
        a.cost.total_cmp(&b.cost).then(a.error.total_cmp(&b.error))
    });
    let mut least = f64::INFINITY;
    order.retain(|i| {
        let is_better = offers[*i].error < least;
        least = least.min(offers[*i].error);
        is_better
    });
    order
}

/// The steps along a front.
pub(crate) fn steps(offers: &[Offer], front: &[usize]) -> Vec<FrontStep> {
    let pairs = front.windows(2);
    pairs
        .map(|pair| {
            let (from, to) = (pair[0], pair[1]);
            let (a, b) = (&offers[from], &offers[to]);
            FrontStep {
                from,
                to,
                cost_ratio: b.cost / a.cost,
                price: price(a, b),
                is_spread_known: a.spread.is_some() && b.spread.is_some(),
            }
        })
        .collect()
}

fn price(from: &Offer, to: &Offer) -> StepPrice {
    let spreads = from.spread.zip(to.spread);
    if spreads.is_some_and(|(a, b)| to.cost - from.cost <= a + b) {
        return StepPrice::WithinSpread;
    }
    if to.error <= 0.0 {
        return StepPrice::ToNoError;
    }
    match (from.error / to.error).log10() {
        decades if decades < LEAST_DECADES => StepPrice::TooShort,
        decades => StepPrice::Factor((to.cost / from.cost).powf(decades.recip())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offers(pairs: &[(f64, f64)]) -> Vec<Offer> {
        let offer = |(error, cost): &(f64, f64)| Offer {
            error: *error,
            cost: *cost,
            spread: Some(0.01),
            is_complete: true,
        };
        pairs.iter().map(offer).collect()
    }

    #[test]
    fn the_front_leaves_out_what_another_beats() {
        // Error falls as the square of cost; the third is beaten by the second, the last is the second again.
        let all = offers(&[
            (100.0, 1.0),
            (1.0, 10.0),
            (2.0, 11.0),
            (0.0, 40.0),
            (1.0, 10.0),
        ]);
        assert_eq!(front(&all), [0, 1, 3]);
        assert_eq!(front(&[]), [0usize; 0]);
        // One that is both cheapest and best is alone.
        assert_eq!(front(&offers(&[(5.0, 2.0), (0.0, 1.0)])), [1]);
    }

    #[test]
    fn the_price_of_a_tenfold_does_not_hang_on_the_length_of_the_step() {
        // cost = error ^ -0.5: a tenfold costs the square root of 10, whatever is sampled.
        for errors in [[1000.0, 10.0, 1.0], [700.0, 90.0, 0.3]] {
            let pairs = errors.map(|e: f64| (e, e.powf(-0.5)));
            let all = offers(&pairs);
            let steps = steps(&all, &front(&all));
            assert_eq!(steps.len(), 2);
            for step in steps {
                let StepPrice::Factor(price) = step.price else {
                    panic!("{step:?}");
                };
                assert!((price - 10_f64.sqrt()).abs() < 1e-12, "{price}");
            }
        }
    }

    #[test]
    fn to_no_error_there_are_no_decades() {
        let all = offers(&[(50.0, 2.0), (0.0, 3.0), (5.0, 2.2)]);
        let steps = steps(&all, &front(&all));
        let last = steps[1];
        assert_eq!(
            (last.from, last.to, last.price),
            (2, 1, StepPrice::ToNoError)
        );
        assert!((last.cost_ratio - 3.0 / 2.2).abs() < 1e-12, "{last:?}");
    }

    #[test]
    fn what_is_not_complete_is_on_no_front() {
        let mut all = offers(&[(100.0, 1.0), (0.0, 2.0), (10.0, 3.0)]);
        assert_eq!(front(&all), [0, 1], "the control");
        all[1].is_complete = false;
        assert_eq!(front(&all), [0, 2]);
    }

    #[test]
    fn short_and_scattered_steps_have_no_price() {
        let price_of = |error: f64, cost: f64, spread: Option<f64>| {
            let mut all = offers(&[(100.0, 2.0), (error, cost)]);
            all.iter_mut().for_each(|o| o.spread = spread);
            let steps = steps(&all, &front(&all));
            (steps[0].price, steps[0].is_spread_known)
        };
        assert_eq!(
            price_of(10.0, 3.0, Some(0.1)),
            (StepPrice::Factor(1.5), true)
        );
        assert_eq!(
            price_of(10.0, 3.0, Some(0.6)),
            (StepPrice::WithinSpread, true)
        );
        assert_eq!(
            price_of(0.0, 3.0, Some(0.6)),
            (StepPrice::WithinSpread, true)
        );
        assert_eq!(price_of(50.0, 3.0, Some(0.1)), (StepPrice::TooShort, true));
        assert!(matches!(
            price_of(46.0, 3.0, None),
            (StepPrice::Factor(_), false)
        ));
    }
}
