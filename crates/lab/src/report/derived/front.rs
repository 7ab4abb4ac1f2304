//! The Pareto front of error against cost, and the price of each tenfold gain in accuracy along the front.
//!
//! An offer (a strategy's error and cost) is on the front if no other offer is as good or better in both. From one offer of the front to
//! the next, the error falls by some decades and the cost rises by a factor. The price of a tenfold gain is the cost factor per decade,
//! so that steps of any length can be compared: `(c1 / c0) ^ (1 / log10(e0 / e1))`. If the error falls to 0, only the cost factor is given.
//!
//! Two kinds of steps have no price: short steps, over which the root amplifies the scatter, and steps whose cost difference is within the
//! spreads. A strategy that did not draw the whole frame has fewer errors and less cost for that reason alone, so it is on no front.

/// Error and cost of one strategy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offer {
    /// Error, 0 or more.
    pub error: f64,
    /// Cost, greater than 0.
    pub cost: f64,
    /// Median absolute deviation of the cost; `None` if unknown.
    pub spread: Option<f64>,
    /// True if the whole frame was drawn.
    pub is_complete: bool,
}

/// Price of a tenfold smaller error along a step of a front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepPrice {
    /// Factor by which the cost rises for each tenfold smaller error.
    Factor(f64),
    /// The error falls to 0, which is no finite number of tenfold steps.
    ToNoError,
    /// The error falls by less than [`LEAST_DECADES`].
    TooShort,
    /// The costs differ by no more than the sum of their spreads, so the step may cost nothing.
    WithinSpread,
}

/// Minimum number of decades by which the error must fall for a step to have a price: at 1/3, 10 % scatter in cost is 33 % in price.
const LEAST_DECADES: f64 = 1.0 / 3.0;

/// The step from one offer of a front to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrontStep {
    /// Index of the cheaper offer.
    pub from: usize,
    /// Index of the more accurate offer.
    pub to: usize,
    /// Cost of the more accurate offer divided by that of the cheaper one.
    pub cost_ratio: f64,
    /// Price of a tenfold smaller error.
    pub price: StepPrice,
    /// True if the spreads of both costs are known.
    pub is_spread_known: bool,
}

/// Indices of the complete offers on the front, the cheapest first. If offers are equal, the first of them is used.
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
        // The error falls with the square of the cost. The third offer is worse than the second; the last is equal to the second.
        let all = offers(&[
            (100.0, 1.0),
            (1.0, 10.0),
            (2.0, 11.0),
            (0.0, 40.0),
            (1.0, 10.0),
        ]);
        assert_eq!(front(&all), [0, 1, 3]);
        assert_eq!(front(&[]), [0usize; 0]);
        // An offer that is both the cheapest and the most accurate is alone on the front.
        assert_eq!(front(&offers(&[(5.0, 2.0), (0.0, 1.0)])), [1]);
    }

    #[test]
    fn the_price_of_a_tenfold_does_not_hang_on_the_length_of_the_step() {
        // cost = error ^ -0.5: a tenfold gain costs the square root of 10, whichever errors are sampled.
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
