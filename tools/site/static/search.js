// From disk a browser fetches no other page, so the search shows no lines of what it found there.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
