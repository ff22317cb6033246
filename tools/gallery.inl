// gallery.inl - what `make gallery` shows: rows of pictures, each made by hair-capture with the arguments beside its
// caption. Paths start where make does.
ROW("Followers and solids: a ball comes into hair that follows three guides at once")
PICTURE("Guides collide; no follower does (collision=none)",
        "tools/scenes/ball.json --show hair,head,solids --set collision=none")
PICTURE("Single strand below the first vertex inside (collision=switch)",
        "tools/scenes/ball.json --show hair,head,solids --set collision=switch")
PICTURE("Pushed out, smoothly (collision=push, the default)",
        "tools/scenes/ball.json --show hair,head,solids --set collision=push")
PICTURE("The guides, and a slice of the field: blue outside, red inside",
        "tools/scenes/ball.json --show guides,solids --set slice=x --set slice_at=0.72")
