def install(generation=2): pass
