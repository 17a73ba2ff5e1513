# Every target is one line that calls cargo, the program or a script. Needed: Rust (rust-toolchain.toml
# names the version), make and a C compiler for linking.

.PHONY: paper quick check latex browser test test-checked test-long lint deny identity archive bench measure clean help

paper: ## the whole reproduction in the full profile, into paper/
	.ci/module && cargo run --release --locked -- paper

quick: ## the same with small samples, into target/paper-quick/
	.ci/module && cargo run --release --locked -- paper --profile quick

check: ## every claim with its verdict; fails if one does not hold
	cargo run --release --locked -- check

latex: ## the documents of paper/ by TeX Live, into target/latex (installed when missing)
	.ci/latex

browser: ## the pages of paper/ in headless Chromium, as readers use them (Chromium and Node installed when missing)
	.ci/browser

test: ## all tests but the long ones
	cargo test --release --locked --workspace

test-long: ## the long test only (a job array on Slurm, which root installs when missing)
	cargo test --release --locked --workspace -- --ignored

test-checked: ## all tests but the long ones, with checks of overflow and debug assertions (compiles everything again)
	CARGO_TARGET_DIR=target/checked CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS=true CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS=true $(MAKE) test

lint: ## formatting, clippy, documentation and spelling, warnings denied
	cargo fmt --check && cargo clippy --release --locked --workspace --all-targets -- -D warnings && RUSTDOCFLAGS="-D warnings" cargo doc --release --locked --no-deps --document-private-items && .ci/spell

deny: ## licences, sources, second versions and known faults of all crates (cargo-deny is built when missing: minutes)
	cargo install --quiet --locked --root target/deny cargo-deny@0.20.2 && target/deny/bin/cargo-deny --locked --workspace check

identity: ## the same bytes for any threads, folder, locale, C library and build (quick profile; minutes to build)
	.ci/identity

archive: ## the last commit and the source of all crates in target/impact-paper.tar.gz, which builds without a network
	.ci/archive

bench: ## how fast the parts are, on this machine
	cargo bench --locked -p impact-bench

measure: ## speed of the engine, of its rivals and of other projects, into benches/measured.json (Python 3)
	python3 benches/peers/measure.py

clean: ## remove everything that was built, saved results included
	cargo clean

help: ## this list
	@sed -n 's/^\([a-z-]*\): ## /\1\t/p' Makefile | expand -t 12
