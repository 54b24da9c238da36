"""Films of runs (docs/movie.md): `polynya movie RUN --out voyage.mp4`, and from Python

    from polynya.movie import film, picture
    run = polynya.Run("runs/sawamura2017-fig4b")
    film.write(run, "voyage.mp4", film.chosen_times(run, speed=20), picture.Look(follow="icebreaker"))

Needs numpy and matplotlib; MP4 and GIF also ffmpeg (./setup.sh python).
"""
