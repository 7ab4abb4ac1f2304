//! Time per pass and per clock: device timestamps, or wall time if timestamps are missing or unreliable.
//!
//! Software adapters are measured by wall time although they offer timestamps: on llvmpipe (Mesa 22.3.6) the begin timestamp of a compute
//! pass is randomly taken before or after the pass's work, so that a frame of 305 ms was reported as 112 ms every other time. For wall time
//! every pass is submitted and awaited separately, at about 0.1 ms each; on these adapters passes would not run in parallel anyway.

use std::time::Duration;

use web_time::Instant;

use crate::plan::{Clock, CpuStep, CpuWork, Recorded};

/// A set of clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct ClockSet(u8);

impl ClockSet {
    /// The empty set.
    pub const NONE: Self = Self(0);
    /// The set of all clocks.
    pub const ALL: Self = Self(7);
    /// The set with only the frame clock.
    pub const FRAME: Self = Self(4);

    /// This set, with a clock added.
    #[must_use]
    pub fn with(self, clock: Clock) -> Self {
        Self(self.0 | 1 << clock as u8)
    }

    /// The clocks of both sets.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns true if a clock is in the set.
    pub fn contains(self, clock: Clock) -> bool {
        self.0 >> clock as u8 & 1 == 1
    }
}

impl FromIterator<Clock> for ClockSet {
    fn from_iter<T: IntoIterator<Item = Clock>>(clocks: T) -> Self {
        clocks.into_iter().fold(Self::NONE, Self::with)
    }
}

/// Time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Name of the pass.
    pub name: String,
    /// Clock of the pass.
    pub clock: Clock,
    /// Milliseconds on the device, or on the CPU for CPU work; none if times were not requested.
    pub time_ms: Option<f64>,
}

impl PassTime {
    /// Times of a plan's CPU steps. `ms` runs the work of a step, and returns the time it took.
    pub(super) fn of_cpu(
        recorded: &Recorded,
        ms: impl Fn(&CpuStep, &CpuWork) -> Option<f64>,
    ) -> Vec<Self> {
        let steps = recorded.plan.on_cpu.iter().zip(&recorded.on_cpu);
        let timed = steps.filter_map(|(step, work)| {
            Some(Self {
                name: step.name.clone(),
                clock: step.clock,
                time_ms: Some(ms(step, work)?),
            })
        });
        timed.collect()
    }
}

/// Times of one run of a program's passes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunTimes {
    /// One entry per pass that ran.
    pub passes: Vec<PassTime>,
    /// Per clock, the time from the begin of its first pass to the end of its last, or the sum of the wall times of its passes. `None` for
    /// clocks that did not run, or if times were not requested.
    pub clocks_ms: [Option<f64>; 3],
}

impl RunTimes {
    /// Times of passes that ran one after another.
    pub(super) fn sum(passes: Vec<PassTime>) -> Self {
        let mut clocks_ms = [None; 3];
        for pass in &passes {
            if let Some(ms) = pass.time_ms {
                *clocks_ms[pass.clock as usize].get_or_insert(0.0) += ms;
            }
        }
        Self { passes, clocks_ms }
    }

    /// Inserts the times of CPU work before those of the passes that waited for it.
    pub(super) fn add_before(&mut self, works: Vec<PassTime>) {
        for work in &works {
            if let Some(ms) = work.time_ms {
                *self.clocks_ms[work.clock as usize].get_or_insert(0.0) += ms;
            }
        }
        self.passes.splice(0..0, works);
    }

    /// Adds the times of a run of the same passes on other rows. Passes that only the other run contains are appended.
    pub(crate) fn add(&mut self, other: Self) {
        for pass in other.passes {
            let known = self.passes.iter_mut().find(|p| p.name == pass.name);
            match known {
                Some(known) => {
                    if let Some(ms) = pass.time_ms {
                        *known.time_ms.get_or_insert(0.0) += ms;
                    }
                }
                None => self.passes.push(pass),
            }
        }
        for (clock, of_other) in self.clocks_ms.iter_mut().zip(other.clocks_ms) {
            if let Some(ms) = of_other {
                *clock.get_or_insert(0.0) += ms;
            }
        }
    }

    /// Time of a clock, 0 if it did not run.
    pub fn clock_ms(&self, clock: Clock) -> f64 {
        self.clocks_ms[clock as usize].unwrap_or(0.0)
    }
}

/// Two timestamps per pass, resolved after the last pass.
pub(super) struct TimestampQueries {
    pub(super) queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    pub(super) copied: wgpu::Buffer,
    count: u32,
}

impl TimestampQueries {
    /// Creates the queries on a device with timestamps; returns none if there are no passes, or too many.
    pub(super) fn new(device: &wgpu::Device, passes: usize) -> Option<Self> {
        let count = u32::try_from(passes * 2).ok();
        let count = count.filter(|c| *c > 0 && *c <= 4096)?;
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: u64::from(count) * 8,
                usage,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            copied: buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
            count,
        })
    }

    pub(super) fn finish(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..self.count, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(
            &self.resolved,
            0,
            &self.copied,
            0,
            u64::from(self.count) * 8,
        );
    }

    /// Converts raw ticks, by pass index, to the times of the passes that ran; `ns_per_tick` is the length of a tick.
    pub(super) fn times(ns_per_tick: f32, ticks: &[u64], ran: &[(usize, &str, Clock)]) -> RunTimes {
        let ms_per_tick = f64::from(ns_per_tick) * 1e-6;
        let mut spans: [Option<(u64, u64)>; 3] = [None; 3];
        let mut passes = Vec::with_capacity(ran.len());
        for (index, name, clock) in ran {
            let (begin, end) = (ticks[index * 2], ticks[index * 2 + 1].max(ticks[index * 2]));
            passes.push(PassTime {
                name: (*name).to_owned(),
                clock: *clock,
                time_ms: Some((end - begin) as f64 * ms_per_tick),
            });
            let span = &mut spans[*clock as usize];
            *span = Some(span.map_or((begin, end), |(b, e)| (b.min(begin), e.max(end))));
        }
        RunTimes {
            passes,
            clocks_ms: spans.map(|s| s.map(|(b, e)| (e - b) as f64 * ms_per_tick)),
        }
    }

    /// Runs CPU work, and returns the milliseconds it took.
    pub(super) fn ms_of(work: &dyn Fn()) -> f64 {
        let started = Self::now();
        work();
        started.elapsed().as_secs_f64() * 1e3
    }

    /// The current time, for adapters without timestamps.
    #[allow(clippy::disallowed_methods, reason = "all time is read in this module")]
    pub(super) fn now() -> Instant {
        Instant::now()
    }
}

/// Runs a function, and adds the time it took to `time`.
pub(super) fn timed<T>(time: &mut Duration, work: impl FnOnce() -> T) -> T {
    let began = TimestampQueries::now();
    let done = work();
    *time += began.elapsed();
    done
}
