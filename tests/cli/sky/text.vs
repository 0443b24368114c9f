(sky #:image "model.vs")
