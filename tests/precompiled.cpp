// No code: what the tests have precompiled needs a source.
