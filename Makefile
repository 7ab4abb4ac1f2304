# Two commands on a fresh machine: `make demo` and `make test`; and `make check`, `make check-all`, `make test-long`, `make docs`, `make gallery`, `make web`, `make check-viewer`, `make check-web`, `make python`, `make archive`. Those that draw install the software Vulkan driver if there is none.

CARGO ?= cargo

# Without it libwayland complains on every start of a graphics driver, over ssh and in containers.
export XDG_RUNTIME_DIR ?= /tmp

# Lints have a target folder of their own, because cargo locks the one that it builds in.
LINTS := $(or $(CARGO_TARGET_DIR),target)/lints
# Make before 4.0, which macOS has, prints both at once.
SYNCED := $(if $(filter output-sync,$(.FEATURES)),--output-sync=target)

.PHONY: archive check check-all check-viewer check-web demo docs gallery lints python setup test test-long tests-built web

# Pictures, a table and a report in target/demo, from the built-in crank: no data to fetch.
demo: setup
	$(CARGO) run --release --quiet -- demo --out target/demo

# The book in target/book, every link of it checked. The first time it builds mdBook for some minutes.
docs:
	CARGO="$(CARGO)" scripts/docs.sh

# The pictures of the documents anew, by the commands of their pages.
gallery: setup
	$(CARGO) build --release --quiet
	scripts/gallery.sh target/release/cutaway

# The viewer as a page: static files in target/page, for any static host. The first time it builds for some 10 minutes.
web:
	CARGO="$(CARGO)" scripts/web.sh

# The page in a real browser, its pictures against those of the command.
check-web: setup web
	$(CARGO) build --release --quiet
	scripts/check-web.sh

# The window on a virtual display, in the profile that tests are built in.
check-viewer: setup tests-built
	scripts/check-viewer.sh $${CARGO_TARGET_DIR:-target}/debug/cutaway-viewer

# What `make test` does not see: the Python module, the window, the page in a browser. In the profile of tests, so that little is built anew; the page in one that compiles soon.
check-all: setup python check-viewer
	CARGO="$(CARGO)" WEB_PROFILE=page-check scripts/web.sh $${CARGO_TARGET_DIR:-target}/page-to-check
	scripts/check-web.sh $${CARGO_TARGET_DIR:-target}/page-to-check $${CARGO_TARGET_DIR:-target}/debug/cutaway-tested

# The Python module: its wheel in target/python/wheels, installed into a fresh environment and tested there. See scripts/python.sh.
python: setup
	CARGO="$(CARGO)" scripts/python.sh

# What a release offers for download: target/archive/cutaway-VERSION-TARGET.tgz.
archive:
	CARGO="$(CARGO)" scripts/archive.sh

# What one runs ten times an hour: nothing here draws.
check:
	$(CARGO) fmt --all --check
	CARGO_TARGET_DIR="$(LINTS)" $(CARGO) clippy --workspace --all-targets -- -D warnings
	$(CARGO) test --workspace --test architecture

# Lints and the build of the tests are chains of crates that keep one core busy each: two at a time take half as long. What either prints
# comes when it has ended.
test: setup
	# One layout, so that a diff shows only what changed.
	$(CARGO) fmt --all --check
	$(MAKE) --jobs=2 $(SYNCED) lints tests-built
	# Everything else, on whatever adapter there is; a software one will do.
	CARGO="$(CARGO)" scripts/test.sh

# In order of cost, so that the cheap complaints come first.
lints: override export CARGO_TARGET_DIR := $(LINTS)
lints:
	# The lints of Cargo.toml, for tests and benches too.
	$(CARGO) clippy --workspace --all-targets -- -D warnings
	# The parts that hosts embed compile by themselves, and for a browser.
	CARGO="$(CARGO)" scripts/check-features.sh
	# Every public item says what it is, and every link in it leads somewhere.
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps

tests-built:
	$(CARGO) test --workspace --no-run

# The tests alone, but whole: random scenes by the thousand, all views, pictures of print sizes. It takes hours on two cores.
test-long: setup
	CUTAWAY_LONG=1 CARGO="$(CARGO)" scripts/test.sh

# Something to draw on: drawing needs a Vulkan driver, and a software one is enough.
setup:
	@scripts/install-driver.sh
