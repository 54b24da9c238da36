// A page opened from disk cannot fetch other pages, so the search shows no excerpts of the results.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
